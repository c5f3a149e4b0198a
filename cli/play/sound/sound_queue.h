// Samples on their way to the loudspeaker, with a clock of what is heard. Independent of the device.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <span>

namespace fbs::cli {

/// Passes samples from the decoder to the device's thread, which fetches them block by block. They are heard
/// later: the device plays one block while it fetches the next. So the queue knows which sample is heard at
/// any time, between two blocks by the monotonic clock.
class SoundQueue {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  /// @param sample_rate  Hz, of both sides
  SoundQueue(int sample_rate, int channels) : rate_(sample_rate), channels_(channels) {}

  /// Drops what has not been fetched; what follows is another time of the stream.
  /// @param time  of the sample added next, 1/kSoundClock s
  void restart(std::int64_t time);
  /// @param samples  the next ones, channels interleaved
  void add(std::span<const std::int16_t> samples);

  /// What the device plays next: silence where nothing has been added.
  /// @param out  whole samples of all channels
  void fetch(std::span<std::int16_t> out, Time now);

  /// Time in the stream of what is heard, 1/kSoundClock s: never before restart()'s, and never going back
  /// until the next one. Stands still while the device plays silence because nothing has been added.
  [[nodiscard]] std::int64_t heard(Time now);

  /// Samples of each channel that have not been fetched.
  [[nodiscard]] std::int64_t waiting() const;

  /// @param gain  0..1, from the next block on
  void set_gain(double gain);

  [[nodiscard]] int sample_rate() const { return rate_; }
  [[nodiscard]] int channels() const { return channels_; }

 private:
  /// Consecutive samples that the device has fetched.
  struct Run {
    std::int64_t fetched;  ///< index of the first among all samples fetched, silence included
    std::int64_t sample;   ///< its index since restart()
    std::int64_t count;
  };
  [[nodiscard]] std::int64_t heard_sample(Time now);

  const int rate_, channels_;
  mutable std::mutex mutex_;
  std::deque<std::int16_t> samples_;
  double gain_ = 1;
  std::int64_t begin_ = 0;    ///< time of restart(), 1/kSoundClock s
  std::int64_t next_ = 0;     ///< index of the first in samples_, since then
  std::int64_t heard_ = 0;    ///< index of the sample heard last, likewise
  std::deque<Run> runs_;      ///< since restart(), not yet heard to the end
  std::int64_t fetched_ = 0;  ///< samples per channel
  std::int64_t block_ = 0;    ///< size of the last fetch
  Time block_time_{};         ///< time of the last fetch
};

}  // namespace fbs::cli
