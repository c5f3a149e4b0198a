#include "encoder/surround/layer_membership.h"

#include <algorithm>
#include <cmath>

#include "encoder/image/robust.h"
#include "encoder/surround/surround_tuning.h"

namespace fbs {

using namespace surround;

LayerShares layers_by_place(const Pose& seen, glm::dvec2 place) {
  const double c = std::cos(seen.roll), s = std::sin(seen.roll);
  const glm::dvec2 d = (place - seen.shift) / seen.eye_distance_px();
  const glm::dvec2 own(c * d.x + s * d.y, -s * d.x + c * d.y);
  // Head and hair: an ellipse around the face that fades outwards.
  const double r = std::hypot(own.x / 1.45, (own.y - 0.3) / 1.95);
  const double head = std::clamp(2.3 - 1.3 * r, 0.0, 1.0);
  // Neck and shoulders: below a line that falls away from the chin, steeper beyond the arms.
  const double x = std::abs(own.x);
  const double line = 1.8 + 0.4 * x + 2 * std::max(0.0, x - 2.8);
  const double body = std::clamp(0.5 + (own.y - line) / 1.2, 0.04, 0.96);
  return {static_cast<float>(head), static_cast<float>((1 - head) * body),
          static_cast<float>((1 - head) * (1 - body))};
}

LayerShares layers_by_map(const SurroundMap& map, glm::dvec2 place) {
  const double x = std::clamp(place.x * map.columns, 0.0, map.columns - 1e-6),
               y = std::clamp(place.y * map.rows, 0.0, map.rows - 1e-6);
  const int c = static_cast<int>(x), r = static_cast<int>(y);
  double head = 0, body = 0;
  for (int dr = 0; dr < 2; ++dr) {
    for (int dc = 0; dc < 2; ++dc) {
      const int k = (r + dr) * (map.columns + 1) + c + dc;
      const double w = (dc == 0 ? 1 - (x - c) : x - c) * (dr == 0 ? 1 - (y - r) : y - r);
      const double h = static_cast<double>(map.head[k]) / kFollowOne;
      head += w * h;
      body += w * (1 - h) * static_cast<double>(map.body[k]) / kFollowOne;
    }
  }
  return {static_cast<float>(head), static_cast<float>(body), static_cast<float>(1 - head - body)};
}

void LayerMembership::set_map(const LayerShares& by_map) {
  share_ = by_map;
  for (std::size_t l = 0; l < kLayerCount; ++l) prior_[l] = kPriorOutsideMap + share_[l];
  update();
}

void LayerMembership::observe(Layer layer, double residual, float rate) {
  constexpr double kSquaredSigma = kOutlierSigma * kOutlierSigma;
  const double squared = residual * residual;
  visible_[layer] = static_cast<float>(geman_mcclure_weight(squared / kSquaredSigma));
  const auto cost = static_cast<float>(geman_mcclure(squared, kSquaredSigma));
  mean_cost_[layer] += rate * (cost - mean_cost_[layer]);
}

void LayerMembership::update() {
  constexpr auto kPerCost = static_cast<float>(kEvidence / (2 * kResidualSigma * kResidualSigma));
  const float least = *std::min_element(mean_cost_.begin(), mean_cost_.end());
  float sum = 0;
  for (std::size_t l = 0; l < kLayerCount; ++l) {
    weight_[l] = prior_[l] * std::exp(-kPerCost * (mean_cost_[l] - least));
    sum += weight_[l];
  }
  for (float& w : weight_) w /= std::max(sum, 1e-6F);
}

}  // namespace fbs
