#include "encoder/retarget/head_surround.h"

#include <algorithm>
#include <cmath>

#include "encoder/model/pose.h"
#include "encoder/surround/layer_membership.h"

namespace fbs {
namespace {

/// A prior of the head above this, which fades over a wide margin, counts as next to the face. Set by eye on
/// four clips: following all of the prior would drag the background along.
constexpr double kNextToFace = 0.75;

}  // namespace

SurroundMap with_hair(SurroundMap map, const VideoFormat& format, const State& rest) {
  const Pose seen = pose_of(rest);
  std::size_t k = 0;
  for (int row = 0; row <= map.rows; ++row) {
    for (int column = 0; column <= map.columns; ++column, ++k) {
      const glm::dvec2 place(static_cast<double>(column) * format.width / map.columns,
                             static_cast<double>(row) * format.height / map.rows);
      const auto prior = static_cast<double>(layers_by_place(seen, place)[kHeadLayer]);
      const double share = std::max(0.0, (prior - kNextToFace) / (1 - kNextToFace));
      map.head[k] = std::max(map.head[k], static_cast<std::uint8_t>(std::lround(kFollowOne * share)));
      if (map.head[k] == kFollowOne) map.body[k] = 0;
    }
  }
  return map;
}

}  // namespace fbs
