// The sound of a recording, picture by picture.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "cli/video/video_sink.h"
#include "decoder/sound/sound_cursor.h"
#include "decoder/sound/sound_parts.h"
#include "encoder/sound/sound_encoder.h"

namespace fbs::cli {

/// Times of a picture's sound in the stream, 1/kSoundClock s.
struct SoundSpan {
  std::int64_t begin = 0, end = 0;
  [[nodiscard]] bool heard() const { return begin < end; }
};

/// Codes the sound of each picture in sequence, whatever was played between them. A picture shown without its
/// sound gets silence. Loudness is the stream's.
class RecordedSound {
 public:
  /// @param parts  must outlive the object; may grow
  static Result<RecordedSound> create(const SoundParts& parts, int sample_rate, int channels);

  /// For SinkOptions.
  [[nodiscard]] const SoundSetup& setup() const { return encoder_->setup(); }

  /// @param span  of the picture written next; empty: silence
  /// @param end   of the picture in the sink, 1/90000 s
  Result<void> write(const SoundSpan& span, std::int64_t end, VideoSink& sink);
  /// Call when the last picture has been written.
  Result<void> finish(VideoSink& sink);

 private:
  RecordedSound(std::unique_ptr<SoundEncoder> encoder, SoundCursor cursor)
      : encoder_(std::move(encoder)), cursor_(std::move(cursor)) {}
  Result<void> write(const SoundEncoder::Frames& frames, VideoSink& sink);
  /// Samples of all channels that are missing before a time in the sink, 1/90000 s.
  [[nodiscard]] std::size_t room(std::int64_t end) const;

  std::unique_ptr<SoundEncoder> encoder_;
  SoundCursor cursor_;
  std::int64_t next_ = -1;             ///< time in the stream after the last span
  std::int64_t end_ = 0;               ///< of the last picture in the sink, 1/90000 s
  std::vector<std::int16_t> waiting_;  ///< a sample that did not fit the last picture
  std::int64_t written_ = 0;           ///< samples per channel
  std::int64_t frames_ = 0;
};

}  // namespace fbs::cli
