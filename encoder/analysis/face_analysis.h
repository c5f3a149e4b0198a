// Pictures of a scene with a face to fitted states and their costs.
#pragma once

#include <optional>

#include "encoder/analysis/picture_analysis.h"
#include "encoder/fit/picture_fit.h"
#include "encoder/settings.h"
#include "encoder/surround/surround_motion.h"
#include "encoder/track/face_search.h"
#include "encoder/track/feature_tracker.h"
#include "encoder/track/head_tracker.h"
#include "encoder/track/landmark_follow.h"

namespace fbs {

/// What a scene begins with. All must outlive the constructor only.
struct AnalysisStart {
  const Setup& setup;
  const Geometry& geometry;    ///< as decoded
  const Picture& first;        ///< source of the scene's first picture
  const Picture& pattern;      ///< the same as decoded: pattern 0
  State seen;                  ///< of pattern 0
  glm::dvec2 centre;           ///< of the head in it, pixels
  double eye_distance_px = 0;  ///< in it
};

/// Tracks head and features, fits the state to each picture and follows body and ground. Holds all that goes
/// on from picture to picture; knows nothing of bits.
class FaceAnalysis {
 public:
  /// @param finder  searches for a lost face; must outlive the object
  FaceAnalysis(const EncoderSettings& settings, const FaceFinder& finder, const AnalysisStart& start);

  struct Observation {
    State state;                       ///< as fitted, in whole units
    bool face = true;                  ///< whether it is followed; else its state is a guess
    PictureCost cost;                  ///< of other states
    std::vector<glm::ivec3> vertices;  ///< project_vertices() of the state
  };
  /// The next picture; the scene's first one first.
  [[nodiscard]] Observation observe(const Picture& picture);

  /// Landmarks of the next picture, by another tracker: its fit starts from them, too.
  void give_landmarks(const LandmarkPoints& landmarks) { given_ = landmarks; }

  /// The next picture begins another shot: the face is elsewhere until it is recognised.
  void cut() { elsewhere_ = true; }

  /// The next picture is the first of a scene that goes on with the same head: body and ground count from
  /// there.
  void begin_scene() { surround_begins_ = true; }

  /// Whether a picture of another shot shows the same head; it is followed again from there on.
  /// @param picture  to be observed next
  [[nodiscard]] bool recognises(const Picture& picture);

  /// From now on the map says which part of the picture moves with what.
  void set_surround_map(const SurroundMap& map);

  /// Of the picture observed last.
  [[nodiscard]] const PictureAnalysis& report() const { return report_; }

 private:
  /// @param first  work frame of the first picture, with colour
  FaceAnalysis(const EncoderSettings& settings, const FaceFinder& finder, const AnalysisStart& start,
               const WorkFrame& first);
  /// Where the head is, tracked or found again; nothing while it is lost.
  /// @param frame  cut where the head was; cut anew where it is found elsewhere
  [[nodiscard]] std::optional<TrackedPose> follow_head(const Picture& picture, const HeadVertices& vertices,
                                                       WorkFrame& frame);
  /// The pose held and the expression a little weaker: a lost face must never look wild.
  [[nodiscard]] Fit relaxed();
  /// Pose as tracked, contours as the snakes see them, all else as before.
  [[nodiscard]] Fit tracked(const WorkFrame& frame, const TrackedPose& head);
  /// Sets now_.
  [[nodiscard]] PictureCost fit_first(const Picture& picture);
  [[nodiscard]] PictureCost fit_next(const Picture& picture);
  /// From the contours' expression, or from another start if that is nearer to the picture: the expression
  /// that its landmarks show, found here or given, whatever came before.
  [[nodiscard]] Fit refined(const Picture& picture, const Fit& tracked);
  void write_report(const Observation& seen);

  bool track_only_, expression_, contours_;
  double eye_distance_px_;
  Geometry geometry_;
  MouthInterior mouth_;
  HeadTracker head_;
  FaceSearch search_;
  FeatureTracker features_;
  std::optional<LandmarkFollow> landmarks_;  ///< nothing when they are not looked for
  LandmarkExpression given_expression_;
  std::optional<LandmarkPoints> given_;  ///< of the next picture
  PictureFit fit_;
  std::optional<SurroundMotion> surround_;  ///< nothing when the surround is held still
  Fit now_;                                 ///< of the last picture
  bool face_shows_ = true;                  ///< in the last picture, and is followed
  bool begun_ = false;
  bool surround_begins_ = false;
  bool elsewhere_ = false;  ///< the shot does not show the face, or not yet
  PictureAnalysis report_;
};

}  // namespace fbs
