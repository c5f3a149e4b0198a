#include "encoder/track/snake/snake_kinds.h"

namespace fbs {
namespace {

// Found by looking at where the contours come to rest on the clips and on the talker. The contrast sets the
// scale. Tension and rigidity smooth, at the cost of corners; temporal steadies, at the cost of lag; shape
// keeps points from sliding along the contour, at the cost of stretching; repulsion holds a mouth with teeth
// open; change tells lips that have arrived from an edge that was there before. After the weights: points,
// blur, above, below, aside.
// clang-format off
constexpr SnakeKind
    kOuterLips = {{.tension = 0.0012, .rigidity = 0.002, .temporal = 0.004, .shape = 0.012, .repulsion = 0.10,
                   .contrast = 1, .change = 0.5},   40, 1.2,   9, 16, 9},
    kInnerLips = {{.tension = 0.0008, .rigidity = 0.002, .temporal = 0.004, .shape = 0.02,  .repulsion = 0.30,
                   .contrast = 1, .change = 0.5},   32, 0.9,   8, 16, 6},
    kBrow      = {{.tension = 2e-5,   .rigidity = 4e-5,  .temporal = 0.02,  .shape = 4e-4,  .repulsion = 0.05,
                   .contrast = 1, .change = 0},     13, 1.2,  10,  7, 6},
    kUpperLid  = {{.tension = 2e-4,   .rigidity = 2e-4,  .temporal = 0.004, .shape = 8e-4,  .repulsion = 0,
                   .contrast = 1, .change = 0},     11, 0.8,   6,  8, 4};
// clang-format on

}  // namespace

const SnakeKind& kind_of(FeatureId id) {
  switch (id) {
    case FeatureId::kMouthOuter:
      return kOuterLips;
    case FeatureId::kMouthInner:
      return kInnerLips;
    case FeatureId::kBrowRight:
    case FeatureId::kBrowLeft:
      return kBrow;
    default:
      return kUpperLid;
  }
}

}  // namespace fbs
