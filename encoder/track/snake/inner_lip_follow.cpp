#include "encoder/track/snake/inner_lip_follow.h"

#include "common/generic_head.h"
#include "encoder/track/snake/control_fit.h"
#include "encoder/track/snake/rest_shape.h"

namespace fbs {
namespace {

/// Skinning weight of a control point at a vertex, 0..1.
double skinning_weight(std::size_t vertex, int control) {
  for (const SkinningWeight& skinning : skinning_of(vertex))
    if (skinning.control == control) return skinning.weight / static_cast<double>(kSkinningOne);
  return 0;
}

}  // namespace

const std::vector<std::vector<double>>& inner_lip_follow() {
  static const std::vector<std::vector<double>> table = [] {
    const Feature &inner = feature(FeatureId::kMouthInner), &outer = feature(FeatureId::kMouthOuter);
    const SnakeCurve curve = curve_of(FeatureId::kMouthInner);
    std::vector<std::vector<double>> follow(inner.control_count, std::vector<double>(outer.control_count));
    for (int c = 0; c < outer.control_count; ++c) {
      std::vector<glm::dvec2> target;
      for (const FeatureVertex& v : inner.vertices)
        target.emplace_back(skinning_weight(v.vertex, outer.first_control + c), 0);
      const auto control = fit_control(inner, curve, target, {});
      for (std::size_t i = 0; i < control.size(); ++i) follow[i][c] = control[i].x;
    }
    return follow;
  }();
  return table;
}

}  // namespace fbs
