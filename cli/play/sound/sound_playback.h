// The sound of a stream for the player: from any time on, decoded a little ahead of what is heard.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "bitstream/syntax.h"
#include "cli/play/sound/sound_queue.h"
#include "decoder/sound/sound_cursor.h"
#include "decoder/sound/sound_parts.h"

namespace fbs::cli {

/// Time of the sound that belongs to a picture. Counts durations of the frame rate, so that their rounding to
/// 1/90000 s does not add up.
/// @return 1/kSoundClock s
[[nodiscard]] std::int64_t sound_time(const StreamPosition& position, Rational rate);

/// Loudness, set by the viewer.
class Volume {
 public:
  /// In steps of kStep percent.
  void change(int steps);
  void toggle_mute() { muted_ = !muted_; }
  /// Factor on the samples: the square of the setting, to match perceived loudness.
  [[nodiscard]] double gain() const;
  /// "muted", "volume 70 %"; empty if as in the stream.
  [[nodiscard]] std::string text() const;

 private:
  static constexpr int kStep = 10;
  int percent_ = 100;
  bool muted_ = false;
};

/// Decodes ahead for the device's thread. Independent of the device.
class SoundPlayback {
 public:
  using Time = SoundQueue::Time;

  /// @param parts  must outlive the object; may grow
  SoundPlayback(const SoundParts& parts, int sample_rate, int channels)
      : cursor_(parts, sample_rate, channels), queue_(sample_rate, channels) {}

  /// @param time  of what is heard next, 1/kSoundClock s
  void start(std::int64_t time);
  void stop();
  [[nodiscard]] bool started() const { return started_; }

  /// Decodes up to kAhead beyond what is heard. While started().
  /// @param known  1/kSoundClock s: what has not arrived before this is lost, and is silence
  void fill(std::int64_t known);

  /// Time of what is heard, 1/kSoundClock s. While started().
  [[nodiscard]] std::int64_t heard(Time now) { return queue_.heard(now); }

  void change_volume(int steps);
  void toggle_mute();
  [[nodiscard]] std::string volume_text() const { return volume_.text(); }

  /// For the device.
  [[nodiscard]] SoundQueue& queue() { return queue_; }

  /// However long a picture takes, the sound continues for this long.
  static constexpr std::chrono::seconds kAhead{1};

 private:
  SoundCursor cursor_;
  SoundQueue queue_;
  Volume volume_;
  bool started_ = false;
};

}  // namespace fbs::cli
