#include "decoder/export/keyframes.h"

#include <algorithm>
#include <limits>

namespace fbs {
namespace {

/// Slopes of the lines from a keyframe that pass within the tolerance of all values since.
class Door {
 public:
  explicit Door(std::span<const double> tolerance)
      : tolerance_(tolerance), low_(tolerance.size()), high_(tolerance.size()) {}

  void open(double time, std::span<const double> value) {
    time_ = time;
    value_ = value;
    std::fill(low_.begin(), low_.end(), -std::numeric_limits<double>::infinity());
    std::fill(high_.begin(), high_.end(), std::numeric_limits<double>::infinity());
  }

  [[nodiscard]] bool lets_through(double time, std::span<const double> value) const {
    for (std::size_t i = 0; i < value.size(); ++i) {
      const double slope = (value[i] - value_[i]) / (time - time_);
      if (slope < low_[i] || slope > high_[i]) return false;
    }
    return true;
  }

  void narrow(double time, std::span<const double> value) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      low_[i] = std::max(low_[i], (value[i] - tolerance_[i] - value_[i]) / (time - time_));
      high_[i] = std::min(high_[i], (value[i] + tolerance_[i] - value_[i]) / (time - time_));
    }
  }

 private:
  std::span<const double> tolerance_;
  double time_ = 0;
  std::span<const double> value_;
  std::vector<double> low_, high_;
};

}  // namespace

std::vector<std::size_t> find_keyframes(std::span<const double> times, std::span<const double> values,
                                        std::span<const double> tolerance) {
  std::vector<std::size_t> keys;
  if (times.empty()) return keys;
  const auto value = [&](std::size_t i) { return values.subspan(i * tolerance.size(), tolerance.size()); };
  Door door(tolerance);
  door.open(times[0], value(0));
  keys.push_back(0);
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (!door.lets_through(times[i], value(i))) {
      keys.push_back(i - 1);
      door.open(times[i - 1], value(i - 1));
    }
    door.narrow(times[i], value(i));
  }
  if (times.size() > 1) keys.push_back(times.size() - 1);
  return keys;
}

}  // namespace fbs
