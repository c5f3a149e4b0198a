// Sounds that speech codecs accept as speech, and comparisons with the decoded sound.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace fbs::test {

using Samples = std::vector<std::int16_t>;

/// Resonances of a vocal tract one after another, each a pair of poles.
class VocalTract {
 public:
  explicit VocalTract(int rate) : rate_(rate) {}

  void shape(std::array<double, 3> formants) {
    for (std::size_t i = 0; i < formants.size(); ++i) {
      const double radius = std::exp(-std::numbers::pi * 90 / rate_);
      poles_[i].a = 2 * radius * std::cos(2 * std::numbers::pi * formants[i] / rate_);
      poles_[i].b = -radius * radius;
    }
  }

  double operator()(double in) {
    for (Pole& pole : poles_) {
      const double out = in * (1 - pole.a - pole.b) + pole.a * pole.y1 + pole.b * pole.y2;
      pole.y2 = pole.y1;
      in = pole.y1 = out;
    }
    return in;
  }

 private:
  struct Pole {
    double a = 0, b = 0, y1 = 0, y2 = 0;
  };
  std::array<Pole, 3> poles_;
  int rate_;
};

inline void scale_to(std::span<const double> wave, double peak, Samples& out) {
  double most = 1e-9;
  for (const double w : wave) most = std::max(most, std::abs(w));
  for (const double w : wave) out.push_back(static_cast<std::int16_t>(std::lround(w / most * peak)));
}

/// Syllables of vowels, of 120 to 300 ms with shorter pauses. The same times at every rate.
inline Samples voice(int rate, double seconds, unsigned seed = 1) {
  constexpr std::array<std::array<double, 3>, 4> kVowels = {
      {{730, 1090, 2440}, {270, 2290, 3010}, {300, 870, 2240}, {530, 1840, 2480}}};
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 1024) / 1024;
  };
  VocalTract tract(rate);
  const auto size = static_cast<std::size_t>(seconds * rate);
  std::vector<double> wave;
  double phase = 0;
  while (wave.size() < size) {
    const double length = between(0.12, 0.3), pause = between(0.04, 0.1), pitch = between(100, 140);
    tract.shape(kVowels[random() % kVowels.size()]);
    for (int i = 0; i < (length + pause) * rate; ++i) {
      const double time = i / (length * rate);
      const double loudness = time < 1 ? std::sin(std::numbers::pi * time) : 0;
      phase += (pitch - 15 * time) / rate;
      const bool pulse = phase >= 1;
      if (pulse) phase -= 1;
      wave.push_back(tract((pulse ? 1.0 : 0.0) * loudness));
    }
  }
  wave.resize(size);
  Samples out;
  scale_to(wave, 12000, out);
  return out;
}

/// One vowel that lasts.
inline Samples vowel(int rate, double seconds) {
  VocalTract tract(rate);
  tract.shape({730, 1090, 2440});
  std::vector<double> wave;
  wave.reserve(static_cast<std::size_t>(seconds * rate));
  for (int i = 0; i < static_cast<int>(seconds * rate); ++i)
    wave.push_back(tract(i % (rate / 120) == 0 ? 1 : 0));
  Samples out;
  scale_to(wave, 12000, out);
  return out;
}

/// Noise with the spectrum of a voice, louder and fainter four times a second, never silent.
inline Samples speech_noise(int rate, double seconds) {
  std::mt19937 random(5);
  VocalTract tract(rate);
  tract.shape({500, 1500, 2500});
  std::vector<double> wave;
  wave.reserve(static_cast<std::size_t>(seconds * rate));
  for (int i = 0; i < static_cast<int>(seconds * rate); ++i) {
    const double loudness = 0.6 + 0.4 * std::sin(2 * std::numbers::pi * 4 * i / rate);
    wave.push_back(tract(loudness * (static_cast<double>(random() % 2001) / 1000 - 1)));
  }
  Samples out;
  scale_to(wave, 12000, out);
  return out;
}

/// A sine from one frequency to another.
inline Samples sweep(int rate, double seconds, double from, double to) {
  Samples out;
  double phase = 0;
  const int size = static_cast<int>(seconds * rate);
  out.reserve(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) {
    phase += (from + (to - from) * i / size) / rate;
    out.push_back(static_cast<std::int16_t>(std::lround(8000 * std::sin(2 * std::numbers::pi * phase))));
  }
  return out;
}

inline double energy(std::span<const std::int16_t> samples) {
  double sum = 0;
  for (const std::int16_t s : samples) sum += static_cast<double>(s) * s;
  return sum / static_cast<double>(std::max<std::size_t>(1, samples.size()));
}

/// Amplitude each ms, over 40 ms: some periods of a voice.
inline std::vector<double> envelope(std::span<const std::int16_t> samples, int rate) {
  const auto hop = static_cast<std::size_t>(rate / 1000), window = hop * 40;
  std::vector<double> out;
  for (std::size_t i = 0; i + window <= samples.size(); i += hop)
    out.push_back(std::sqrt(energy(samples.subspan(i, window))));
  return out;
}

/// Correlation coefficient of a[i] and b[i + lag].
template <class A, class B>
double correlation(const A& a, const B& b, int lag) {
  double aa = 1e-9, bb = 1e-9, ab = 0, sum_a = 0, sum_b = 0;
  int count = 0;
  for (int i = std::max(0, -lag); i < static_cast<int>(std::min(a.size(), b.size())) - std::max(0, lag);
       ++i) {
    const double x = a[static_cast<std::size_t>(i)], y = b[static_cast<std::size_t>(i + lag)];
    aa += x * x, bb += y * y, ab += x * y, sum_a += x, sum_b += y, ++count;
  }
  if (count == 0) return 0;
  ab -= sum_a * sum_b / count, aa -= sum_a * sum_a / count, bb -= sum_b * sum_b / count;
  return ab / std::sqrt(aa * bb);
}

/// The lag at which b follows a best, and how well.
struct Alignment {
  int lag = 0;
  double correlation = -2;
};
template <class A, class B>
Alignment align(const A& a, const B& b, int most) {
  Alignment best;
  for (int lag = -most; lag <= most; ++lag)
    if (const double c = correlation(a, b, lag); c > best.correlation) best = {lag, c};
  return best;
}

}  // namespace fbs::test
