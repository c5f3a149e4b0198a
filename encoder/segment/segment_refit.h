// Fits states to the blend: once a segment has its patterns, the state of each picture is fitted again, to
// the blend instead of pattern 0, and the motion of the segment is planned for those states.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "encoder/analysis/face_analysis.h"
#include "encoder/plan/motion_track.h"
#include "encoder/segment/segment_renderer.h"

namespace fbs {

/// Draws each picture as the decoder does and treats it as a pattern seen in the picture's own state;
/// comparison with the source then gives the cost of other states. A picture that is a pattern keeps its
/// state, as a fixed reference for the others. Body and ground keep their costs: fitting them again, by
/// drawing with each of their numbers changed, gained 0.6 % in the frame (four clips) and took longer than
/// everything else. Keeps about a kilobyte per picture.
class SegmentRefit {
 public:
  /// @param first            pattern 0
  /// @param eye_distance_px  in its picture
  /// @param motion           as before the first segment
  SegmentRefit(const Setup& setup, const Geometry& geometry, const Pattern& first, double eye_distance_px,
               MotionTrack motion);

  /// The next picture of the segment, as analysed.
  void add(const FaceAnalysis::Observation& picture);
  /// A group ends with the picture added last.
  /// @param durations  of its pictures, 1/90000 s; 0: nominal
  void end_group(std::vector<std::uint32_t> durations) { durations_.push_back(std::move(durations)); }

  /// Replaces the motion of a segment whose pictures have been added: payloads of groups and states of
  /// pictures. Blend modes stay. Can be run again: each time starts from the motion before the segment.
  /// @param patterns  of the segment; the caller updates their seen states
  Result<void> run(Segment& segment, const SegmentPatterns& patterns, Workers& workers);

  /// The motion as after the segment, if run() has replaced it.
  [[nodiscard]] const std::optional<MotionTrack>& motion() const { return after_; }

  /// Forgets the pictures.
  /// @param motion  as before the segment
  void begin_segment(const MotionTrack& motion);

 private:
  static constexpr int kSurroundCount = 2 * kSimilarityCount;
  struct Analysed {
    State state;
    bool face;
    double eye_distance_px;                       ///< FaceAnalysis::Observation's
    std::array<double, kSurroundCount> surround;  ///< of PictureCost::fit: body and ground
    cv::Matx<double, kSurroundCount, kSurroundCount> surround_quadratic;
  };
  /// A picture of the segment that is fitted again.
  struct Shown {
    const Analysed& analysed;
    const Picture& source;
    const State& state;  ///< as planned
    bool pattern;        ///< whether it is one
  };
  /// What a worker needs for it.
  struct Tools {
    PictureFit fit;
    SegmentRenderer renderer;
  };
  [[nodiscard]] static Result<PictureCost> cost_of(const Shown& shown, Tools& tools);
  [[nodiscard]] static Result<PictureCost> head_cost(const Shown& shown, Tools& tools);

  PictureFit fit_;
  std::vector<Analysed> pictures_;
  std::vector<std::vector<std::uint32_t>> durations_;  ///< of the pictures, by group
  MotionTrack before_;                                 ///< the segment
  std::optional<MotionTrack> after_;                   ///< it, as run() planned it last
};

}  // namespace fbs
