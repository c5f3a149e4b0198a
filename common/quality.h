// Similarity of two pictures: PSNR.
#pragma once

#include <cstdint>

#include "common/picture.h"

namespace fbs {

/// Squared differences summed over any number of samples and pictures.
struct SquaredError {
  std::uint64_t sum = 0;
  std::uint64_t count = 0;

  void add(int a, int b) {
    sum += static_cast<std::uint64_t>((a - b) * (a - b));
    ++count;
  }
  SquaredError& operator+=(const SquaredError& other) {
    sum += other.sum;
    count += other.count;
    return *this;
  }

  friend bool operator==(const SquaredError&, const SquaredError&) = default;

  /// 10 log10(255^2 / mean); 99 for identical pictures; 0 without samples. dB.
  [[nodiscard]] double psnr() const;
};

/// Over a whole plane; both have the same size.
[[nodiscard]] SquaredError squared_error(const Plane& a, const Plane& b);

/// Only where `mask` (same size) is not zero.
[[nodiscard]] SquaredError squared_error(const Plane& a, const Plane& b, const Plane& mask);

}  // namespace fbs
