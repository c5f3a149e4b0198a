// Values over time as keyframes, without those that linear interpolation reproduces.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace fbs {

/// Finds the keyframes of a curve in one pass: a run continues as long as a line from its first value to its
/// last stays within the tolerance of all between (the "swinging door" of data historians, Bristol 1990).
/// @param times      s, ascending
/// @param values     `size` numbers for each time, concatenated
/// @param tolerance  for each of the `size` numbers; 0: exact
/// @return indices of times, ascending; the first and the last are among them
[[nodiscard]] std::vector<std::size_t> find_keyframes(std::span<const double> times,
                                                      std::span<const double> values,
                                                      std::span<const double> tolerance);

}  // namespace fbs
