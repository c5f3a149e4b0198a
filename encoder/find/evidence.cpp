#include "encoder/find/evidence.h"

#include <algorithm>
#include <cmath>

namespace fbs {

using namespace find_tuning;

double search(double from, double to, double usual, double sigma,
              const std::function<double(double)>& evidence) {
  constexpr double kStep = 1.0 / 128;
  double best = usual, best_score = -1e30;
  for (double p = from; p <= to; p += kStep) {
    const double d = (p - usual) / sigma;
    const double score = evidence(p) - d * d;
    if (score > best_score) {
      best_score = score;
      best = p;
    }
  }
  return best;
}

double mean_over(double centre, double half, const std::function<double(double)>& value) {
  double sum = 0;
  constexpr int kSamples = 13;
  for (int i = 0; i < kSamples; ++i) sum += value(centre + half * (2.0 * i / (kSamples - 1) - 1));
  return sum / kSamples;
}

double border_evidence(const FaceFrame& face, double x, double y) {
  const double luma = std::abs(face.luma(x - kBorderLumaReach, y) - face.luma(x + kBorderLumaReach, y));
  const double red = std::abs(face.red(x - kBorderRedReach, y) - face.red(x + kBorderRedReach, y));
  return std::min(kMaxBorderEvidence, luma / kBorderLumaPerEvidence + red / kBorderRedPerEvidence);
}

}  // namespace fbs
