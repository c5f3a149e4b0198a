// States fitted to what is shown: once a segment has patterns, each of its pictures is drawn from them and
// its state fitted anew, and the motion of the segment is planned for those states.
#pragma once

#include <span>
#include <vector>

#include "encoder/face_analysis.h"
#include "encoder/motion_track.h"
#include "encoder/segment_blend.h"

namespace fbs {

class SegmentRefit {
 public:
  /// @param first  pattern 0
  /// @param eye_distance_px  in its picture
  SegmentRefit(const Setup& setup, const Geometry& geometry, const Pattern& first, double eye_distance_px);

  /// The next picture of the segment, as it was fitted to pattern 0.
  /// @param duration  1/90000 s; 0: nominal
  void add(const FaceAnalysis::Observation& picture, std::uint32_t duration);

  /// Replaces the motion of the segment: its groups' payloads and its pictures' states. Blend modes stay.
  /// @param setup   of the scene
  /// @param motion  as before the segment; afterwards as after it
  Result<void> run(Segment& segment, const SegmentPatterns& patterns, const Setup& setup,
                   MotionTrack& motion);

  /// Forgets the pictures.
  void begin_segment() { pictures_.clear(); }

 private:
  /// What of an observation a new cost is made from.
  struct Fitted {
    Fit fit;
    bool seen;
    std::uint32_t duration;
    std::array<double, 2 * kSimilarityCount> surround;  ///< fit of body and ground, units of State
    cv::Mat1d surround_cost;                            ///< quadratic over them
  };
  /// @param drawn  the picture as the decoder draws it in `state`
  [[nodiscard]] PictureCost cost_of(const Fitted& fitted, const Picture& source, const Picture& drawn,
                                    const State& state, double interior_opacity, const MouthInterior& mouth);

  double eye_distance_px_;
  PictureFit fit_;
  std::vector<Fitted> pictures_;
  std::vector<State> last_fits_;
  std::array<double, 4> frame_{};
};

}  // namespace fbs
