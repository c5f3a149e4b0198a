#include "encoder/plan/rate_control.h"

#include <algorithm>
#include <cmath>

namespace fbs {
namespace {

/// Rate that motion takes at a quality, about; measured on ten clips.
double usual_motion_kbps(int quality) {
  return 1.0 * std::exp2((quality - 50) / 30.0);
}

}  // namespace

int quality_for(double kbps, double seconds, const std::function<std::size_t(int)>& startup) {
  const auto fits = [&](int quality) {
    return 8e-3 * static_cast<double>(startup(quality)) / seconds + usual_motion_kbps(quality) <= kbps;
  };
  int low = 0, high = 101;  // the first that is not known to be too much
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

double RateBudget::allowed(double seconds) const {
  const double even = bits_per_second_ * seconds;
  return std::max(0.25 * even, even + 0.5 * left_);
}

void RateBudget::spend(double bits, double seconds) {
  left_ += bits_per_second_ * seconds - bits;
}

double lambda_for(double allowed, double lambda, double rest, const std::function<double(double)>& bits) {
  constexpr double kClose = 0.03;
  const double least = rest / 64, most = rest * 4096;
  double low = 0, high = 0;  // too many bits, few enough; zero: not known
  for (int i = 0; i < 9; ++i) {
    const double b = bits(lambda);
    if (b <= allowed && b >= (1 - kClose) * allowed) return lambda;
    (b > allowed ? low : high) = lambda;
    if (low > 0 && high > 0) {
      lambda = std::sqrt(low * high);
    } else {
      const double next = std::clamp(b > allowed ? lambda * 4 : lambda / 4, least, most);
      if (next == lambda) return lambda;
      lambda = next;
    }
  }
  return high > 0 ? high : lambda;
}

}  // namespace fbs
