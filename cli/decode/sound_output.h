// The sound of a stream, beside its pictures or alone.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cli/video/video_sink.h"
#include "common/result.h"
#include "decoder/sound/decoded_sound.h"
#include "encoder/sound/sound_encoder.h"

namespace fbs::cli {

// Times are in 1/kSoundClock s of the stream.

/// Sound for a video sink: Opus is copied; Codec 2, which containers do not know, becomes Opus.
class SinkSound {
 public:
  /// @param known  parts that have arrived
  /// @param begin  time 0 of the sink
  static Result<SinkSound> create(const SoundSetup& setup, std::span<const SoundPart> known,
                                  std::int64_t begin);

  /// For SinkOptions.
  [[nodiscard]] const SoundSetup& setup() const { return setup_; }

  /// Whether silence in the stream costs time and memory; gaps in Opus are left as they are.
  [[nodiscard]] bool fills_gaps() const { return transcoder_.has_value(); }

  /// Leaves out a part too far ahead of its pictures (kMaxSoundAhead).
  Result<void> add(SoundPart part);
  /// Writes the sound before a time.
  Result<void> write(std::int64_t end, VideoSink& sink);
  /// Call when the last pictures have been written.
  Result<void> finish(VideoSink& sink);

 private:
  struct Transcoder {
    DecodedSound decoded;
    std::unique_ptr<SoundEncoder> encoder;
    std::int64_t frames = 0;  ///< coded so far
  };
  using Frame = std::pair<std::int64_t, std::vector<std::uint8_t>>;  ///< time in the sink, bytes

  SinkSound(const SoundSetup& setup, std::int64_t begin) : setup_(setup), begin_(begin) {}
  void wait(std::int64_t time, std::vector<std::uint8_t> frame);
  void wait(SoundEncoder::Frames frames);
  Result<void> write_waiting(std::int64_t end, VideoSink& sink);

  SoundSetup setup_;
  std::int64_t begin_;
  std::deque<Frame> waiting_;
  std::size_t waiting_size_ = 0;          ///< memory_of() waiting_
  std::optional<Transcoder> transcoder_;  ///< for Codec 2
};

}  // namespace fbs::cli
