// One scene: from the picture that shows the face first to the next cut or the end.
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "bitstream/payload/motion_payload.h"
#include "common/result.h"
#include "decoder/renderer.h"
#include "encoder/encoder.h"
#include "encoder/find/adapt.h"
#include "encoder/fit/picture_fit.h"
#include "encoder/patterns/mouth_colours.h"
#include "encoder/plan/operating_point.h"
#include "encoder/plan/rate_control.h"
#include "encoder/plan/track_plan.h"
#include "encoder/surround/surround_motion.h"
#include "encoder/surround/surround_observations.h"
#include "encoder/track/face_search.h"
#include "encoder/track/feature_tracker.h"
#include "encoder/track/head_tracker.h"

namespace fbs {

class SceneEncoder {
 public:
  /// A scene that begins with a face.
  /// @param finder  used again when the face is lost; must outlive the object
  static Result<SceneEncoder> begin(const VideoFormat& format, const EncoderSettings& settings,
                                    const FaceFinder& finder, const Picture& first, const Marks& marks);

  /// A scene without a face: the picture is shown as it is as long as it lasts.
  static Result<SceneEncoder> begin_without_face(const VideoFormat& format, const EncoderSettings& settings,
                                                 const Picture& first);

  /// The first picture too is pushed.
  Result<void> push(const Picture& picture, std::uint32_t duration);

  /// Ends the scene.
  Result<void> finish();

  /// Whole packets that are ready.
  [[nodiscard]] std::vector<std::uint8_t> take();

  [[nodiscard]] const PictureAnalysis& analysis() const { return analysis_; }

 private:
  SceneEncoder(const VideoFormat& format, const EncoderSettings& settings);
  /// Quality, steps and rates. Needs the geometry's bytes.
  Result<OperatingPoint> choose_point(const Picture& first);
  Result<void> add_pattern(const Picture& picture, int quantiser);
  /// Where the head is, tracked or found again; nothing while it is lost.
  /// @param frame  cut where the head was; cut anew where it is found elsewhere
  [[nodiscard]] std::optional<TrackedPose> follow_head(const Picture& picture, const HeadVertices& vertices,
                                                       WorkFrame& frame);
  /// Of a lost picture: held, and the expression a little weaker. Never a wild face.
  [[nodiscard]] Fit relaxed();
  /// What the next picture shows, and in `cost` how surely.
  [[nodiscard]] Fit analyse(const Picture& picture, PictureCost& cost);
  void report(const State& state);
  Result<void> start();
  Result<void> end_group();
  /// The group's tracks; where a rate is set, with the lambda that keeps it.
  [[nodiscard]] MotionGroup plan_group(const CodedState& anchor, bool key);
  /// Key flag and durations.
  void finish_group(MotionGroup& group, bool key) const;

  EncoderSettings settings_;
  int group_pictures_ = 30;
  int lookahead_ = 60;

  Scene scene_;              ///< as the decoder has it; until start() the surround's map is a guess
  CodedState seen_coded_{};  ///< of pattern 0
  State seen_;
  double eye_distance_px_ = 0;
  std::optional<HeadTracker> head_;
  std::optional<FaceSearch> search_;
  std::optional<FeatureTracker> features_;
  std::optional<PictureFit> fit_;
  std::optional<SurroundMotion> surround_;  ///< nothing when the surround is held still
  Fit now_;                                 ///< of the last picture

  std::optional<MotionCoder> coder_;
  std::optional<TrackPlanner> planner_;
  TrackRate rate_;
  double lambda_ = 0;                 ///< that the quality stands for
  std::optional<RateBudget> budget_;  ///< of the motion, where a rate is set
  std::vector<PictureCost> costs_;    ///< of the group's pictures
  std::vector<std::uint32_t> durations_;
  std::uint64_t pictures_ = 0;

  MouthColours mouth_colours_;
  std::optional<SurroundObservations> observations_;  ///< kept until the surround's map has been fitted
  std::vector<std::uint8_t> geometry_bytes_, pattern_bytes_;
  std::vector<std::uint8_t> held_back_;  ///< motion packets that wait for the scene's start
  std::vector<std::uint8_t> ready_;
  bool started_ = false;
  PictureAnalysis analysis_;
};

}  // namespace fbs
