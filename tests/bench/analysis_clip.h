// The talker, forwards and backwards, with the output of each stage computed once, so that each stage can be
// timed alone on its real input.
#pragma once

#include <array>
#include <vector>

#include "common/generic_head.h"
#include "encoder/find/adapt.h"
#include "encoder/fit/picture_fit.h"
#include "encoder/track/feature_tracker.h"
#include "encoder/track/head_tracker.h"
#include "tests/unit/talker_clip.h"

namespace fbs {

/// One picture of the analysis.
struct AnalysedPicture {
  Picture picture;
  WorkFrame frame;  ///< with colour
  TrackedPose tracked;
  std::array<glm::dvec2, kVertexCount> flow{};
  Fit tracked_fit;   ///< pose and snakes, the light of the picture before
  PictureCost cost;  ///< near the refined fit
};

class AnalysisClip {
 public:
  static constexpr int kPictures = 24;

  AnalysisClip();

  /// A round is 2 (kPictures - 1) pictures; then the first follows again, as the neighbour of the last.
  [[nodiscard]] const std::vector<AnalysedPicture>& round() const { return round_; }

  [[nodiscard]] const Setup& setup() const { return setup_; }
  [[nodiscard]] const Geometry& geometry() const { return head_.geometry; }
  [[nodiscard]] const Pose& pose() const { return head_.pose; }  ///< of the first picture
  [[nodiscard]] const State& seen() const { return seen_; }      ///< the same, quantised
  [[nodiscard]] const CodedState& seen_coded() const { return seen_coded_; }
  [[nodiscard]] const WorkFrame& first() const { return first_; }
  [[nodiscard]] double eye_distance_px() const { return head_.pose.eye_distance_px(); }
  [[nodiscard]] double lambda() const { return lambda_; }
  [[nodiscard]] const HeadVertices& neutral() const { return neutral_; }
  [[nodiscard]] VideoFormat format() { return clip_.format(); }

 private:
  TalkerClip clip_;
  AdaptedHead head_;
  HeadVertices neutral_{};
  WorkFrame first_;
  Setup setup_;
  CodedState seen_coded_{};
  State seen_;
  double lambda_ = 0;
  std::vector<AnalysedPicture> round_;
};

/// Made on first use: benchmarks that are filtered out cost nothing.
[[nodiscard]] AnalysisClip& analysis_clip();

}  // namespace fbs
