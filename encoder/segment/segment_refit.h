// States fitted to what is shown: once a segment has its patterns, the state of each picture is fitted anew,
// to the blend instead of pattern 0, and the motion of the segment is planned for those states.
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "encoder/analysis/face_analysis.h"
#include "encoder/plan/motion_track.h"
#include "encoder/segment/segment_renderer.h"

namespace fbs {

/// Each picture is drawn as the decoder draws it and then taken for a pattern seen in the picture's own
/// state, about which the cost of others follows from the picture's source. A picture that is a pattern keeps
/// its state, so that the others have something to be fitted to. Body and ground keep the costs that they
/// had: fitted anew by drawing with each of their numbers changed, they gained 0.6 % in the frame (four
/// clips) and took longer than all else. Keeps about a kilobyte for each picture.
class SegmentRefit {
 public:
  /// @param first            pattern 0
  /// @param eye_distance_px  in its picture
  /// @param motion           as before the first segment
  SegmentRefit(const Setup& setup, const Geometry& geometry, const Pattern& first, double eye_distance_px,
               MotionTrack motion);

  /// The next picture of the segment, as analysed.
  /// @param duration  1/90000 s; 0: nominal
  void add(const FaceAnalysis::Observation& picture, std::uint32_t duration);

  /// Replaces the motion of a segment whose pictures have been added: payloads of groups, states of pictures.
  /// Blend modes stay. Can be run again: each time starts from the motion before the segment.
  /// @param patterns  that it is drawn from; their seen states are left to the caller
  Result<void> run(Segment& segment, const SegmentPatterns& patterns);

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
    std::uint32_t duration;
    std::array<double, kSurroundCount> surround;  ///< of PictureCost::fit: body and ground
    cv::Matx<double, kSurroundCount, kSurroundCount> surround_quadratic;
  };
  /// A picture of the segment that is fitted anew.
  struct Shown {
    const Analysed& analysed;
    const Picture& source;
    const State& state;  ///< as planned
    bool pattern;        ///< whether it is one
  };
  [[nodiscard]] Result<PictureCost> cost_of(const Shown& shown, SegmentRenderer& renderer,
                                            const MouthInterior& mouth);
  [[nodiscard]] Result<PictureCost> head_cost(const Shown& shown, SegmentRenderer& renderer,
                                              const MouthInterior& mouth);

  double eye_distance_px_;
  PictureFit fit_;
  std::vector<Analysed> pictures_;
  MotionTrack before_;                ///< the segment
  std::optional<MotionTrack> after_;  ///< it, as run() planned it last
};

}  // namespace fbs
