#include "tests/figures/face_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fbs::figures {
namespace {

constexpr int kLongest = 30;                 // pictures of one motion
constexpr double kLow = 0.05, kHigh = 0.98;  // quantiles that count as the ends of a motion

double distance(glm::dvec2 a, glm::dvec2 b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// The steps of `levels` (from low to high) in the pictures up to `last`, backwards.
struct Stretch {
  std::vector<int> pictures;  ///< ascending
  double error = 0;           ///< sum of squared differences from the levels
};

/// Nan measures are never nearest.
Stretch stretch_before(int last, const std::vector<double>& measure, const std::vector<double>& levels) {
  Stretch out;
  for (std::size_t k = levels.size(); k-- > 0;) {
    int best = last;
    double least = std::numeric_limits<double>::infinity();
    // The top is at `last` itself; the others leave room for those below them.
    const int begin = k + 1 == levels.size() ? last : std::max(last - kLongest + 1, static_cast<int>(k));
    const int end = out.pictures.empty() ? last + 1 : out.pictures.back();
    for (int i = begin; i < end; ++i) {
      const double d = std::abs(measure[i] - levels[k]);
      if (d < least) {
        least = d;
        best = i;
      }
    }
    out.pictures.push_back(best);
    out.error += least * least;
  }
  std::reverse(out.pictures.begin(), out.pictures.end());
  return out;
}

}  // namespace

FaceMotion face_motion(const Landmarks& p) {
  // The corners: the middle of the lids goes down with a blink.
  const glm::dvec2 right = 0.5 * (p[36] + p[39]), left = 0.5 * (p[42] + p[45]);
  const double eyes = distance(right, left);
  FaceMotion m;
  m.mouth_height = distance(p[51], p[57]) / eyes;
  m.brow_raise = 0.5 * (distance(p[19], right) + distance(p[24], left)) / eyes;
  m.eye_open =
      0.25 *
      (distance(p[37], p[41]) + distance(p[38], p[40]) + distance(p[43], p[47]) + distance(p[44], p[46])) /
      eyes;
  return m;
}

double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<int> rising(const std::vector<double>& measure, int count) {
  const double low = quantile(measure, kLow), high = quantile(measure, kHigh);
  std::vector<double> levels;
  for (int k = 0; k < count; ++k) levels.push_back(low + (high - low) * k / (count - 1));
  Stretch best;
  best.error = std::numeric_limits<double>::infinity();
  for (int last = count - 1; last < static_cast<int>(measure.size()); ++last) {
    Stretch s = stretch_before(last, measure, levels);
    if (s.error < best.error || best.pictures.empty()) best = std::move(s);
  }
  return best.pictures;
}

int lowest(const std::vector<double>& measure) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < measure.size(); ++i)
    if (std::isnan(measure[best]) || measure[i] < measure[best]) best = i;
  return static_cast<int>(best);
}

}  // namespace fbs::figures
