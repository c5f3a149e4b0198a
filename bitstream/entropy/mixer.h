// Codes one bit with a probability mixed from several contexts. SPEC 2.5.
//
// A single context is either specific, with few bits to learn from, or general. A mixer weights the estimates
// of several contexts and adapts the weights, which depend on how many bits each context has coded.
// Method: M. Mahoney, Adaptive Weighing of Context Models for Lossless Data Compression, 2005 (logistic
// mixing). Differs: integers only, weights by the experience of the contexts, log-odds to base two.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "bitstream/entropy/adaptive_bit.h"
#include "bitstream/entropy/logistic.h"

namespace fbs {

inline constexpr int kExperienceLevels = 6;  ///< AdaptiveBit::experience()
inline constexpr std::int32_t kMixerWeightOne = 1 << 16;

template <std::size_t N>
class Mixer {
 public:
  using Inputs = std::array<AdaptiveBit*, N>;

  /// Codes `value` with the mixed estimate of `inputs`, then updates them and the weights. Returns the value.
  template <class Coder>
  bool code(Coder& coder, const Inputs& inputs, bool value) {
    std::array<std::int32_t, N> odds;
    std::array<std::int32_t*, N> weight;
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < N; ++i) {
      odds[i] = stretch(inputs[i]->zero());
      weight[i] = &weights_[i][inputs[i]->experience()];
      sum += std::int64_t{odds[i]} * *weight[i];
    }
    const std::int64_t limit = std::int64_t{12} << 32;
    const std::uint32_t zero = squash(static_cast<std::int32_t>(std::clamp(sum, -limit, limit) >> 16));
    value = coder.raw_bit(zero, value);

    // Gradient of the cost: (coded - expected) * log-odds.
    const std::int32_t error =
        (value ? 0 : static_cast<std::int32_t>(kProbabilityOne)) - static_cast<std::int32_t>(zero);
    for (std::size_t i = 0; i < N; ++i) {
      const std::int64_t step = (std::int64_t{odds[i]} * error) >> kRateShift;
      *weight[i] =
          static_cast<std::int32_t>(std::clamp<std::int64_t>(*weight[i] + step, -kMaxWeight, kMaxWeight));
      inputs[i]->update(value);
    }
    return value;
  }

 private:
  static constexpr int kRateShift = 22;  // a learning rate of 1/64
  static constexpr std::int32_t kMaxWeight = 8 * kMixerWeightOne;

  using Weights = std::array<std::int32_t, kExperienceLevels>;
  static constexpr std::array<Weights, N> initial() {
    std::array<Weights, N> weights{};
    // In 1/16 of an even share: the more bits a context has coded, the larger its weight.
    constexpr std::array<std::int32_t, kExperienceLevels> kShare = {4, 6, 9, 13, 18, 20};
    for (auto& input : weights) {
      for (std::size_t level = 0; level < kExperienceLevels; ++level) {
        input[level] = kMixerWeightOne * kShare[level] / (16 * static_cast<std::int32_t>(N));
      }
    }
    return weights;
  }

  std::array<Weights, N> weights_ = initial();  // 1/kMixerWeightOne
};

}  // namespace fbs
