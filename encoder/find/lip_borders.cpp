#include "encoder/find/lip_borders.h"

#include <algorithm>
#include <array>

#include "encoder/find/evidence.h"

namespace fbs {

using namespace find_tuning;

namespace {

double squared(double v) {
  return v * v;
}

/// Luma and redness down the midline, in residual sigmas, as running sums.
class Profile {
 public:
  Profile(const FaceFrame& f, double middle, double line) {
    for (int i = 0; i < kProfileSamples; ++i) {
      const double at = line + (i - kProfileLine) * kProfileStep;
      const double y =
          mean_over(middle, kProfileHalf, [&](double x) { return f.luma(x, at); }) / kProfileLumaSigma;
      const double r =
          mean_over(middle, kProfileHalf, [&](double x) { return f.red(x, at); }) / kProfileRedSigma;
      const Sums& s = upto_[i];
      upto_[i + 1] = {s.y + y, s.yy + y * y, s.r + r, s.rr + r * r};
    }
  }

  /// Squared deviations from the mean within [from, to).
  [[nodiscard]] double deviation(int from, int to) const {
    const Sums &a = upto_[from], &b = upto_[to];
    const double n = to - from, y = b.y - a.y, r = b.r - a.r;
    return b.yy - a.yy - y * y / n + b.rr - a.rr - r * r / n;
  }
  [[nodiscard]] double mean_red(int from, int to) const {
    return (upto_[to].r - upto_[from].r) / (to - from);
  }

 private:
  struct Sums {
    double y = 0, yy = 0, r = 0, rr = 0;
  };
  std::array<Sums, kProfileSamples + 1> upto_{};
};

/// Of borders at samples: top and inner border of the upper lip, inner border and bottom of the lower one.
double cost_of(const Profile& p, int top, int upper, int lower, int bottom) {
  constexpr int kEnd = kProfileSamples;
  const double open = (lower - upper) * kProfileStep;
  double cost = p.deviation(0, top) + p.deviation(top, upper) + p.deviation(upper, lower) +
                p.deviation(lower, bottom) + p.deviation(bottom, kEnd);
  cost *= kVarianceCost;
  cost += squared(((upper - top) * kProfileStep - kUpperLip) / kUpperLipSigma) +
          squared(((bottom - lower) * kProfileStep - kLowerLip) / kLowerLipSigma);
  cost += kOpenCost * open;
  // Both lips are redder than the skin, and what lies between them is not redder than they are.
  const double lips = std::min(p.mean_red(top, upper), p.mean_red(lower, bottom));
  const double skin = 0.5 * (p.mean_red(0, top) + p.mean_red(bottom, kEnd));
  cost -= kRednessCost * std::clamp(lips - skin, kMinLipRedness, kMaxLipRedness);
  cost += kRednessCost * std::clamp(p.mean_red(upper, lower) - lips, 0.0, kMaxInnerRedness);
  return cost;
}

/// Calls visit(top, upper, lower, bottom) for all borders that are searched.
template <class Visit>
void for_borders(Visit visit) {
  for (int t = kMinSkinSamples; t < kProfileLine - 2; ++t)
    for (int u = t + kMinUpperSamples; u <= kProfileLine + 1; ++u)
      for (int l = std::max(u + 1, kProfileLine); l <= std::min(u + kMaxOpenSamples, kProfileSamples - 10);
           ++l)
        for (int b = l + kMinLowerSamples;
             b <= std::min(l + kMaxLowerSamples, kProfileSamples - kMinBelowSamples); ++b)
          visit(t, u, l, b);
}

}  // namespace

LipBorders find_lip_borders(const FaceFrame& face, double middle, double line) {
  const Profile profile(face, middle, line);
  double least = 1e30;
  std::array<int, 4> best{};
  for_borders([&](int t, int u, int l, int b) {
    const double cost = cost_of(profile, t, u, l, b);
    if (cost < least) {
      least = cost;
      best = {t, u, l, b};
    }
  });
  const auto y = [&](int sample) { return line + (sample - kProfileLine - 0.5) * kProfileStep; };
  return {y(best[0]), y(best[1]), y(best[2]), y(best[3])};
}

}  // namespace fbs
