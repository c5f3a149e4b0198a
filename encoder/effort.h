// What EncoderSettings::effort stands for.
#pragma once

#include <array>
#include <cstddef>

namespace fbs {

/// Each step takes more time than the one before and fewer bytes; docs/encode.md says how much. The first
/// refit gains 4 % of the rate in the face and 1 % in the frame (four clips), the second 0.8 and 0.3 %.
/// Solving twice would lose 2 % in the face for 1 % in the frame.
struct Effort {
  static constexpr int kMost = 9, kDefault = 5;

  int pattern_speed;                     ///< Av1Settings::speed of patterns that are sent
  bool tries_sizes;                      ///< patterns are coded on trial to choose their size
  bool solves;                           ///< for patterns; otherwise they are source pictures
  int refits;                            ///< rounds of fitting states to the blend
  std::size_t draft_pictures, pictures;  ///< most that share blend errors, in drafts and at the end

  /// @param effort  0..kMost
  [[nodiscard]] static constexpr Effort of(int effort) {
    constexpr std::array<Effort, kMost + 1> kEfforts = {{
        {5, false, false, 0, 3, 2},
        {5, false, false, 1, 3, 1},
        {5, false, true, 1, 3, 1},
        {5, true, true, 1, 3, 1},
        {4, true, true, 1, 3, 1},
        {3, true, true, 1, 3, 1},
        {3, true, true, 2, 3, 1},
        {3, true, true, 2, 2, 1},
        {2, true, true, 2, 1, 1},
        {1, true, true, 2, 1, 1},
    }};
    return kEfforts[static_cast<std::size_t>(effort)];
  }
};

}  // namespace fbs
