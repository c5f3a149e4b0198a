// The sound of a stream as the player needs it: from any time on, a little ahead of what is heard.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "bitstream/syntax.h"
#include "cli/play/sound/sound_queue.h"
#include "decoder/sound/sound_cursor.h"
#include "decoder/sound/sound_parts.h"

namespace fbs::cli {

/// Time of a picture as that of the sound that belongs to it. Durations of the frame rate are counted, so
/// that their rounding to 1/90000 s does not add up.
/// @return 1/kSoundClock s
[[nodiscard]] std::int64_t sound_time(const StreamPosition& position, Rational rate);

/// Loudness, as the viewer sets it.
class Volume {
 public:
  /// In steps of kStep percent.
  void change(int steps);
  void toggle_mute() { muted_ = !muted_; }
  /// Factor of the samples: the square of the share, since loudness is felt so.
  [[nodiscard]] double gain() const;
  /// "muted", "volume 70 %"; nothing where it is as in the stream.
  [[nodiscard]] std::string text() const;

 private:
  static constexpr int kStep = 10;
  int percent_ = 100;
  bool muted_ = false;
};

/// Decodes ahead for the thread of the device. Knows no device.
class SoundPlayback {
 public:
  using Time = SoundQueue::Time;

  /// @param parts  must outlive the object; may grow
  SoundPlayback(const SoundParts& parts, int sample_rate, int channels)
      : cursor_(parts, sample_rate, channels), queue_(sample_rate, channels) {}

  /// @param time  1/kSoundClock s, of what is heard next
  void start(std::int64_t time);
  void stop();
  [[nodiscard]] bool started() const { return started_; }

  /// Decodes up to kAhead more than is heard. While started().
  /// @param known  1/kSoundClock s: up to here what has not come will not come, and is silence
  void fill(std::int64_t known);

  /// Time of what is heard, 1/kSoundClock s. While started().
  [[nodiscard]] std::int64_t heard(Time now) { return queue_.heard(now); }

  void change_volume(int steps);
  void toggle_mute();
  [[nodiscard]] std::string volume_text() const { return volume_.text(); }

  /// For the device.
  [[nodiscard]] SoundQueue& queue() { return queue_; }

  /// However long a picture takes, the sound goes on for so long.
  static constexpr std::chrono::seconds kAhead{1};

 private:
  SoundCursor cursor_;
  SoundQueue queue_;
  Volume volume_;
  bool started_ = false;
};

}  // namespace fbs::cli
