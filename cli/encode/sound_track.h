// The sound of a source, coded in step with the pictures.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/files/stop_signal.h"
#include "cli/video/sound_source.h"
#include "encoder/sound/sound_encoder.h"

namespace fbs::cli {

class SoundTrack {
 public:
  /// @param track  number among the sound tracks of the file; none: the main one
  /// @param end    time of the end of the pictures, 1/90000 s, if it is known
  /// @param stop   ends code_all(); must outlive the object
  /// @return null when the source has no sound; errors of open_sound_source() and SoundEncoder
  static Result<std::unique_ptr<SoundTrack>> open(const std::string& input, const SoundSettings& settings,
                                                  std::optional<int> track, std::optional<std::int64_t> end,
                                                  const StopSignal& stop);

  [[nodiscard]] const SoundSetup& setup() const { return encoder_->setup(); }
  /// Codes all of the source at once. @return kbit/s that it takes of the stream
  Result<double> code_all();
  /// As required by SoundFeed. Reads no farther than necessary.
  Result<std::vector<SoundGroup>> before(std::int64_t time);

 private:
  SoundTrack(std::unique_ptr<SoundSource> source, std::unique_ptr<SoundEncoder> encoder,
             const StopSignal& stop)
      : source_(std::move(source)), encoder_(std::move(encoder)), stop_(stop) {}

  /// Codes what the source has next. @return false at its end
  Result<bool> read_more();

  std::unique_ptr<SoundSource> source_;
  std::unique_ptr<SoundEncoder> encoder_;
  const StopSignal& stop_;
  std::deque<std::vector<std::uint8_t>> frames_;  ///< that have not been asked for
  std::int64_t first_ = 0;                        ///< number of the first of them
  bool ended_ = false;
};

}  // namespace fbs::cli
