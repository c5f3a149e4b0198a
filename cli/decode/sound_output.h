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
#include "decoder/sound/sound_reader.h"
#include "decoder/stream_decoder.h"
#include "encoder/sound/sound_encoder.h"

namespace fbs::cli {

// Times are in 1/kSoundClock s of the stream.

/// The sound of a stream as samples without gaps. Sound comes before its pictures; it is given with them, and
/// what is after the last picture is not.
class DecodedSound {
 public:
  /// @param begin  time of the first sample: what is before is left out
  explicit DecodedSound(std::int64_t begin) : begin_(begin) {}

  Result<void> add(SoundPart part);

  /// The samples before a time that have not been taken; silence where there is no sound. Not before add().
  [[nodiscard]] std::vector<std::int16_t> take(std::int64_t end);

  [[nodiscard]] int sample_rate() const { return sample_rate_; }  ///< 0 before add()
  [[nodiscard]] int channels() const { return channels_; }

 private:
  [[nodiscard]] std::int64_t place_of(std::int64_t time) const {
    return (time - begin_) * sample_rate_ / kSoundClock;
  }
  void append(const SoundPiece& piece);

  SoundReader reader_;
  std::int64_t begin_;
  int sample_rate_ = 0, channels_ = 1;
  std::int64_t taken_ = 0;             ///< samples of each channel
  std::vector<std::int16_t> samples_;  ///< that follow
};

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
