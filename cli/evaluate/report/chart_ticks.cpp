#include "cli/evaluate/report/chart_ticks.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <span>

namespace fbs::cli {
namespace {

constexpr double kSlack = 1e-9;  // relative: a round number at the end of the axis gets its tick

std::vector<double> digits_times_powers(std::span<const double> digits, double low, double high) {
  std::vector<double> out;
  for (double power = std::pow(10, std::floor(std::log10(low))); power <= high; power *= 10)
    for (const double digit : digits)
      if (const double v = digit * power; v >= low * (1 - kSlack) && v <= high * (1 + kSlack))
        out.push_back(v);
  return out;
}

}  // namespace

std::vector<double> linear_ticks(double low, double high, int wanted) {
  const double rough = (high - low) / wanted;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double digit : {5.0, 2.0, 1.0})
    if (digit * power >= rough * (1 - kSlack)) step = digit * power;
  std::vector<double> out;
  const double slack = kSlack * (high - low);
  for (double n = std::ceil((low - slack) / step); n * step <= high + slack; ++n) out.push_back(n * step);
  return out;
}

std::vector<double> log_ticks(double low, double high) {
  constexpr std::array kFew{1.0, 2.0, 5.0};
  constexpr std::array kAll{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0};
  auto out = digits_times_powers(kFew, low, high);
  if (out.size() < 3) out = digits_times_powers(kAll, low, high);
  if (out.size() < 3) out = linear_ticks(low, high, 4);
  return out;
}

std::string tick_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", std::abs(value) < 1e-12 ? 0 : value);
  return text.data();
}

}  // namespace fbs::cli
