#include "encoder/surround/global_motion.h"

#include <algorithm>

#include "encoder/surround/similarity_alignment.h"
#include "encoder/surround/surround_tuning.h"

namespace fbs {

using namespace surround;

namespace {

/// The anchor is replaced once a corner of the picture has moved by this share of the long side. Farther, the
/// pictures have less in common; nearer, drift adds up.
constexpr double kAnchorReach = 0.12;

/// Motion is trusted if it leaves less than this share of the cost at rest.
constexpr double kBelieved = 0.95;

PlaneMotion plane_motion(const Similarity& s, double unit_px) {
  return {1.0 + std::complex(s[kSimilarityScale], s[kSimilarityRotation]) / unit_px,
          {s[kDisplacementX], s[kDisplacementY]}};
}

Similarity plus(Similarity a, const Similarity& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

Similarity minus(Similarity a, const Similarity& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

}  // namespace

void GlobalMotion::set_anchor(const PlaneMotion& since_first) {
  anchor_ = since_first;
  now_ = {};
  keypoints_ = select_ground_keypoints(luma_, factor_, middle_, unit_px_);
}

glm::dvec2 GlobalMotion::correlated(const SurroundPyramid& before) const {
  cv::Mat1f a, b;
  before[1].convertTo(a, CV_32F);
  luma_[1].convertTo(b, CV_32F);
  const cv::Point2d shift = cv::phaseCorrelate(a, b);
  return 2.0 * glm::dvec2(shift.x, shift.y);
}

GlobalMotion::Observation GlobalMotion::observe(const Picture& picture) {
  const SurroundPyramid before = luma_;
  factor_ = reduction_factor(picture.width(), picture.height(), kMotionLongSide);
  middle_ = {picture.width() / 2.0, picture.height() / 2.0};
  unit_px_ = std::max(picture.width(), picture.height()) / 2.0;
  luma_ = make_pyramid<kSurroundLevels>(reduced(picture.y, factor_));
  Observation out;
  if (keypoints_.empty()) {
    set_anchor(anchor_.then(plane_motion(now_, unit_px_)));
    velocity_ = {};
  } else {
    const SimilarityAlignment alignment(keypoints_, luma_, factor_, unit_px_);
    const auto cost = [&](const Similarity& s) { return alignment.cost(kGroundLayer, s); };
    Similarity best = now_;
    double least = kBelieved * cost(now_);
    const glm::dvec2 jump = static_cast<double>(factor_) * correlated(before);
    for (const Similarity& start : {plus(now_, velocity_), plus(now_, {jump.x, jump.y, 0, 0})}) {
      const Similarity found = alignment.align(kGroundLayer, start, start);
      if (const double c = cost(found); c < least) {
        least = c;
        best = found;
      }
    }
    velocity_ = minus(best, now_);
    now_ = best;
    out.moved = cost(now_);
    out.still = cost({});
  }
  const PlaneMotion since_anchor = plane_motion(now_, unit_px_);
  out.since_first = anchor_.then(since_anchor);
  for (const Keypoint& k : keypoints_)
    out.places.push_back({k.place + displacement(now_, k.from_head) - middle_, k.structure});
  const double reach = std::abs(since_anchor.shift) + std::abs(since_anchor.turn - 1.0) * unit_px_;
  if (reach > kAnchorReach * 2 * unit_px_) set_anchor(out.since_first);
  return out;
}

}  // namespace fbs
