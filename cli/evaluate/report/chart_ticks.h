// Round numbers along the axes of a chart.
#pragma once

#include <string>
#include <vector>

namespace fbs::cli {

/// Multiples of 1, 2 or 5 times a power of ten within low..high, about `wanted` of them.
/// @param low, high  finite, low < high
[[nodiscard]] std::vector<double> linear_ticks(double low, double high, int wanted);

/// 1, 2 and 5 times powers of ten within low..high; if these are fewer than three, all digits 1 to 9; if
/// these are still too few, linear_ticks().
/// @param low, high  finite, 0 < low < high
[[nodiscard]] std::vector<double> log_ticks(double low, double high);

/// A number without trailing zeros: "0.5", "20", "1500".
[[nodiscard]] std::string tick_text(double value);

}  // namespace fbs::cli
