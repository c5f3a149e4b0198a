#include "encoder/surround/surround_motion.h"

#include <algorithm>

#include "encoder/surround/surround_tuning.h"

namespace fbs {

using namespace surround;

SurroundMotion::SurroundMotion(const Picture& first, const State& seen)
    : factor_(reduction_factor(first.width(), first.height(), kMotionLongSide)),
      seen_(pose_of(seen)),
      width_(first.width()),
      height_(first.height()),
      luma_(make_pyramid<kSurroundLevels>(reduced(first.y, factor_))),
      keypoints_(select_keypoints(luma_, factor_, seen_)),
      ground_shows_(ground_shows(keypoints_)) {}

void SurroundMotion::accept(const SimilarityAlignment& alignment, Layer layer, const Similarity& rest,
                            bool rim_only, Part& part) {
  const double still = alignment.cost(layer, rest, rim_only),
               moved = alignment.cost(layer, part.aligned, rim_only);
  part.moves =
      moved < (part.moves ? kStopMoving : kBeginMoving) * still && (part.moves || still - moved > kMinGain);
  part.accepted = part.moves ? part.aligned : rest;
}

Similarity SurroundMotion::align_body(const SimilarityAlignment& alignment, const Similarity& rest,
                                      glm::dvec2 head_displacement) const {
  Similarity best = alignment.align(kBodyLayer, body_.aligned, rest);
  double least = alignment.cost(kBodyLayer, best);
  if (least < kRestartBody * alignment.cost(kBodyLayer, rest)) return best;
  const glm::dvec2 with_head = kBodyPerHead * head_displacement;
  for (const Similarity& start : {rest, Similarity{with_head.x, with_head.y, 0, 0}}) {
    const Similarity found = alignment.align(kBodyLayer, start, rest);
    if (const double cost = alignment.cost(kBodyLayer, found); cost < least) {
      least = cost;
      best = found;
    }
  }
  return best;
}

void SurroundMotion::observe(const Picture& picture, const Pose& head) {
  luma_ = make_pyramid<kSurroundLevels>(reduced(picture.y, factor_));
  const SimilarityAlignment alignment(keypoints_, luma_, factor_, seen_.eye_distance_px());
  const Similarity none{};
  // Where the ground does not show, it may follow what neither head nor body explains: long hair in front of
  // an even wall (woman_presenter_700: 24.1 -> 25.8 dB).
  ground_.aligned = alignment.align(kGroundLayer, ground_.aligned, none);
  accept(alignment, kGroundLayer, none, ground_shows_, ground_);
  const Similarity& rest = ground_shows_ ? ground_.accepted : none;
  body_.aligned = align_body(alignment, rest, head.shift - seen_.shift);
  accept(alignment, kBodyLayer, rest, false, body_);
  refine_layers(head);
}

void SurroundMotion::refine_layers(const Pose& head) {
  const auto moved = HeadDisplacement::between(seen_, head);
  if (!moved) return;
  head_ = *moved;
  const auto rate = static_cast<float>(1 / std::min<double>(kMemory, ++pictures_));
  const auto to_work = static_cast<double>(factor_);
  for (Keypoint& keypoint : keypoints_) {
    const std::array<glm::dvec2, kLayerCount> by = {
        head_(keypoint.place) / to_work, displacement(body_.accepted, keypoint.from_head) / to_work,
        displacement(ground_.accepted, keypoint.from_head) / to_work};
    for (const Layer layer : {kHeadLayer, kBodyLayer, kGroundLayer}) {
      const glm::dvec2 at = keypoint.at + by[layer];
      if (has_cell(luma_[0], at)) {
        const double now = bilinear<std::uint8_t>(luma_[0], BilinearCell(at));
        keypoint.layers.observe(layer, now - static_cast<double>(keypoint.seen[0].value), rate);
      } else {
        keypoint.layers.observe_hidden(layer);
      }
    }
    keypoint.layers.update();
  }
}

void SurroundMotion::set_map(const SurroundMap& map) {
  mapped_ = true;
  for (Keypoint& keypoint : keypoints_)
    keypoint.layers.set_map(layers_by_map(map, keypoint.place / glm::dvec2(width_, height_)));
}

void SurroundMotion::add_to(State& state) const {
  for (std::size_t i = 0; i < kSimilarityCount; ++i) {
    state.body[i] = to_state(body_.accepted[i]);
    state.ground[i] = to_state(ground_.accepted[i]);
  }
}

void SurroundMotion::add_to(PictureCost& cost) const {
  const LayerMotion motion{head_, body_.accepted, ground_.accepted};
  cost.layers.push_back({CostLayer::kSurround, 0,
                         surround_constant(keypoints_, mapped_, luma_[0], factor_, motion),
                         surround_quadratic(keypoints_, mapped_)});
  for (std::size_t i = 0; i < kSimilarityCount; ++i) {
    cost.fit[first_of(PartId::kBody) + i] = kStateUnitsPerPixel * body_.accepted[i];
    cost.fit[first_of(PartId::kGround) + i] = kStateUnitsPerPixel * ground_.accepted[i];
  }
}

}  // namespace fbs
