// The sound of a stream as the player in a browser takes it: from any time on, as far as it has come.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "decoder/sound/sound_cursor.h"
#include "decoder/sound/sound_parts.h"

namespace fbs::web {

class WebSound {
 public:
  WebSound() { parts_.follow_pictures(); }
  WebSound(const WebSound&) = delete;
  WebSound& operator=(const WebSound&) = delete;

  /// @param bytes  the next ones of the stream
  void add(std::span<const std::uint8_t> bytes) { parts_.add(bytes); }

  /// End of the pictures that have arrived, with all before them, 1/90000 s.
  [[nodiscard]] std::uint64_t released() const { return parts_.released(); }

  /// Hz; 0 as long as no sound has come that can be decoded.
  [[nodiscard]] int sample_rate();
  [[nodiscard]] int channels() { return sample_rate() > 0 ? channels_ : 0; }

  /// @param time  1/kSoundClock s, of the next sample
  void seek(std::int64_t time);
  /// Samples from where the last call ended to `end`, or to where sound has come, channels interleaved.
  [[nodiscard]] std::vector<std::int16_t> take(std::int64_t end);
  /// Time of the next sample, 1/kSoundClock s.
  [[nodiscard]] std::int64_t time() const { return cursor_ ? cursor_->time() : begin_; }

 private:
  /// Up to here sound that has not come will not come, 1/kSoundClock s.
  [[nodiscard]] std::int64_t known() const;

  SoundParts parts_;
  std::optional<SoundCursor> cursor_;  ///< once a codec is known
  int sample_rate_ = 0, channels_ = 0;
  std::int64_t begin_ = 0;  ///< of the last seek()
};

}  // namespace fbs::web
