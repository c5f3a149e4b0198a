// Sound whose place can be measured: short bursts of a tone, one a second, at irregular times.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace fbs {

/// Seconds, of bursts number 0, 1, ...
inline double burst_time(int number) {
  return number + 0.1 + number * 37 % 100 / 200.0;
}

/// Mono, `seconds` long; a burst is 10 ms of a cosine of 1 kHz.
inline std::vector<std::int16_t> tone_bursts(int sample_rate, int seconds) {
  std::vector<std::int16_t> samples(static_cast<std::size_t>(sample_rate) *
                                    static_cast<std::size_t>(seconds));
  for (int number = 0; number < seconds; ++number) {
    const auto first = static_cast<std::size_t>(std::llround(burst_time(number) * sample_rate));
    for (std::size_t i = 0; i < static_cast<std::size_t>(sample_rate / 100); ++i) {
      const double phase = 2 * std::numbers::pi * 1000 * static_cast<double>(i) / sample_rate;
      samples[first + i] = static_cast<std::int16_t>(std::lround(20000 * std::cos(phase)));
    }
  }
  return samples;
}

/// Seconds at which bursts begin in the first of `channels` interleaved channels.
inline std::vector<double> burst_onsets(std::span<const std::int16_t> samples, int sample_rate,
                                        std::size_t channels = 1) {
  constexpr int kLoud = 6000;
  std::vector<double> onsets;
  double quiet_since = -1;
  for (std::size_t i = 0; i < samples.size(); i += channels) {
    if (std::abs(samples[i]) < kLoud) continue;
    const double time = static_cast<double>(i) / static_cast<double>(channels) / sample_rate;
    if (time - quiet_since > 0.05) onsets.push_back(time);
    quiet_since = time;
  }
  return onsets;
}

/// Seconds by which burst `number` is later than `expected`; far when there is none.
inline double burst_lag(const std::vector<double>& onsets, double expected) {
  double lag = 1e6;
  for (const double onset : onsets) {
    if (std::abs(onset - expected) < std::abs(lag)) lag = onset - expected;
  }
  return lag;
}

}  // namespace fbs
