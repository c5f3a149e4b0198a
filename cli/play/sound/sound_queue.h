// Samples on their way to the loudspeaker, and which of them is heard. Knows no device.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace fbs::cli {

/// Between who decodes sound and the thread of the device, which fetches it block by block. What the device
/// has fetched is heard later: it plays the block before while it fetches one. So the queue knows which
/// sample is heard at any time, between two blocks by the monotonic clock.
class SoundQueue {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  /// @param sample_rate  Hz, of both sides
  SoundQueue(int sample_rate, int channels) : rate_(sample_rate), channels_(channels) {}

  /// Forgets what has not been fetched; what follows is another time of the stream.
  /// @param time  1/kSoundClock s, of the sample that is added next
  void restart(std::int64_t time);
  /// @param samples  that follow, channels interleaved
  void add(std::span<const std::int16_t> samples);

  /// What the device plays next: silence where nothing has been added.
  /// @param out  whole samples of all channels
  void fetch(std::span<std::int16_t> out, Time now);

  /// Time in the stream of what is heard, 1/kSoundClock s: never before that of restart(), never going back
  /// until the next one. It stands still where the device plays silence because nothing has been added.
  [[nodiscard]] std::int64_t heard(Time now);

  /// Samples of each channel that have not been fetched.
  [[nodiscard]] std::int64_t waiting() const;

  /// @param gain  0..1, from the next block on
  void set_gain(double gain);

  [[nodiscard]] int sample_rate() const { return rate_; }
  [[nodiscard]] int channels() const { return channels_; }

 private:
  /// Samples that the device has fetched one after another.
  struct Run {
    std::int64_t fetched;  ///< number of the first in all that was fetched, silence too
    std::int64_t sample;   ///< its number since restart()
    std::int64_t count;
  };
  [[nodiscard]] std::int64_t heard_sample(Time now);

  const int rate_, channels_;
  mutable std::mutex mutex_;
  std::deque<std::int16_t> samples_;
  double gain_ = 1;
  std::int64_t begin_ = 0;    ///< time of restart(), 1/kSoundClock s
  std::int64_t next_ = 0;     ///< number since then of the first in samples_
  std::int64_t heard_ = 0;    ///< the same of what was heard last
  std::deque<Run> runs_;      ///< since restart(), not all over
  std::int64_t fetched_ = 0;  ///< samples of each channel
  std::int64_t block_ = 0;    ///< size of the last fetch
  Time block_time_{};         ///< and its time
};

}  // namespace fbs::cli
