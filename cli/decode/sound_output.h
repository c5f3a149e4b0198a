// The sound of a stream, beside its pictures or alone.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cli/stream/decoded_sound.h"
#include "cli/video/video_sink.h"
#include "common/result.h"
#include "decoder/stream_decoder.h"
#include "encoder/sound/sound_encoder.h"

namespace fbs::cli {

// Times are in 1/kSoundClock s of the stream.

/// Sound into a sink of video: Opus as it is; Codec 2, which containers do not know, becomes Opus.
class SinkSound {
 public:
  /// @param known  parts that have come already
  /// @param begin  time 0 of the sink
  static Result<SinkSound> create(const SoundSetup& setup, std::span<const SoundPart> known,
                                  std::int64_t begin);

  /// For SinkOptions.
  [[nodiscard]] const SoundSetup& setup() const { return setup_; }

  Result<void> add(SoundPart part);
  /// Writes what is heard before a time.
  Result<void> write(std::int64_t end, VideoSink& sink);
  /// The last pictures have been written.
  Result<void> finish(VideoSink& sink);

 private:
  struct Transcoder {
    DecodedSound decoded;
    std::unique_ptr<SoundEncoder> encoder;
    std::int64_t frames = 0;  ///< coded
  };
  using Frame = std::pair<std::int64_t, std::vector<std::uint8_t>>;  ///< time in the sink, bytes

  SinkSound(const SoundSetup& setup, std::int64_t begin) : setup_(setup), begin_(begin) {}
  void wait(const SoundEncoder::Frames& frames);

  SoundSetup setup_;
  std::int64_t begin_;
  std::deque<Frame> waiting_;
  std::optional<Transcoder> transcoder_;  ///< of Codec 2
};

}  // namespace fbs::cli
