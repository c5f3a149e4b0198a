// Fits states, and their costs, to the pictures of a scene with a face.
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

/// The start of a scene. Everything need only outlive the constructor.
struct AnalysisStart {
  const Setup& setup;
  const Geometry& geometry;    ///< as decoded
  const Picture& first;        ///< source of the scene's first picture
  const Picture& pattern;      ///< the same as decoded: pattern 0
  State seen;                  ///< of pattern 0
  glm::dvec2 centre;           ///< of the head in it, pixels
  double eye_distance_px = 0;  ///< in it
};

/// Tracks head and features, fits the state to each picture and tracks body and ground. Holds everything that
/// lasts from picture to picture; independent of bits.
class FaceAnalysis {
 public:
  /// @param finder  searches for a lost face; must outlive the object
  FaceAnalysis(const EncoderSettings& settings, const FaceFinder& finder, const AnalysisStart& start);

  struct Observation {
    State state;                       ///< as fitted, in whole units
    bool face = true;                  ///< whether it is tracked; otherwise its state is a guess
    PictureCost cost;                  ///< of other states
    std::vector<glm::ivec3> vertices;  ///< project_vertices() of the state
  };
  /// Observes the next picture, beginning with the scene's first.
  [[nodiscard]] Observation observe(const Picture& picture);

  /// Landmarks of the next picture, by another tracker: its fit starts from them, too.
  void give_landmarks(const LandmarkPoints& landmarks) { given_ = landmarks; }

  /// The next picture begins another shot: the face is absent until recognised.
  void cut() { elsewhere_ = true; }

  /// The next picture begins a scene with the same head: body and ground count from there.
  void begin_scene() { surround_begins_ = true; }

  /// Whether a picture of another shot shows the same head, which is then tracked again.
  /// @param picture  to be observed next
  [[nodiscard]] bool recognises(const Picture& picture);

  /// Sets the map that says how each part of the picture moves from now on.
  void set_surround_map(const SurroundMap& map);

  /// Report of the picture observed last.
  [[nodiscard]] const PictureAnalysis& report() const { return report_; }

 private:
  /// @param first  work frame of the first picture, with colour
  FaceAnalysis(const EncoderSettings& settings, const FaceFinder& finder, const AnalysisStart& start,
               const WorkFrame& first);
  /// Pose of the head, tracked or found again; nothing while it is lost.
  /// @param frame  cut where the head was; cut anew where it is found elsewhere
  [[nodiscard]] std::optional<TrackedPose> follow_head(const Picture& picture, const HeadVertices& vertices,
                                                       WorkFrame& frame);
  /// Holds the pose and weakens the expression a little: a lost face must never look wild.
  [[nodiscard]] Fit relaxed();
  /// Pose as tracked, contours from the snakes, the rest as before.
  [[nodiscard]] Fit tracked(const WorkFrame& frame, const TrackedPose& head);
  /// Sets now_.
  [[nodiscard]] PictureCost fit_first(const Picture& picture);
  [[nodiscard]] PictureCost fit_next(const Picture& picture);
  /// Refines from the contours' expression, or from another start that is nearer to the picture: the
  /// expression of its landmarks, found here or given, independent of earlier pictures.
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
