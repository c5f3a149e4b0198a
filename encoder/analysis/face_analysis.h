// Fits states, and their costs, to the pictures of a scene with a face.
#pragma once

#include <optional>

#include "common/workers.h"
#include "encoder/analysis/picture_analysis.h"
#include "encoder/fit/picture_fit.h"
#include "encoder/settings.h"
#include "encoder/track/feature_tracker.h"
#include "encoder/track/head_follow.h"
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
  int threads = 1;             ///< at least 1; the fits are the same
  Hooks hooks{};
};

/// Tracks head and features and fits the state to each picture. Holds everything about the face that lasts
/// from picture to picture; independent of bits. Body and ground are observed where the pictures are coded.
class FaceAnalysis {
 public:
  /// @param finder  searches for a lost face; must outlive the object
  FaceAnalysis(const EncoderSettings& settings, const FaceFinder& finder, const AnalysisStart& start);

  struct Observation {
    State state;                       ///< as fitted, in whole units
    bool face = true;                  ///< whether it is tracked; otherwise its state is a guess
    PictureCost cost;                  ///< of other states
    std::vector<glm::ivec3> vertices;  ///< project_vertices() of the state
    Pose pose;                         ///< as fitted
    double eye_distance_px = 0;        ///< the scale of the shot's work frames
    bool in_shot = true;               ///< as far as is known, the shot shows the head
  };
  /// Observes the next picture, beginning with the scene's first.
  [[nodiscard]] Observation observe(const Picture& picture);

  /// Landmarks of the next picture, by another tracker: its fit starts from them, too.
  void give_landmarks(const LandmarkPoints& landmarks) { landmarks_.give(landmarks); }

  /// The next picture begins another shot: the face is absent until recognised.
  void cut() { head_.cut(); }

  /// Whether a picture of another shot shows the same head, which is then tracked again.
  /// @param picture  to be observed next
  [[nodiscard]] bool recognises(const Picture& picture) {
    return head_.recognises(picture, now_.pose, skinned(geometry_, now_.offsets));
  }

  /// Report of the picture observed last.
  [[nodiscard]] const PictureAnalysis& report() const { return report_; }

 private:
  /// @param first  work frame of the first picture, with colour
  FaceAnalysis(const EncoderSettings& settings, const FaceFinder& finder, const AnalysisStart& start,
               const WorkFrame& first);
  /// Holds the pose and weakens the expression a little: a lost face must never look wild.
  [[nodiscard]] Fit relaxed();
  /// Pose as tracked, contours from the snakes, the rest as before.
  [[nodiscard]] Fit tracked(const HeadFollow::Found& head);
  /// Sets now_.
  [[nodiscard]] PictureCost fit_first(const Picture& picture);
  [[nodiscard]] PictureCost fit_next(const Picture& picture);
  /// Refines from the contours' expression, or from another start that is nearer to the picture: the
  /// expression of its landmarks, found here or given, independent of earlier pictures.
  [[nodiscard]] Fit refined(const Picture& picture, const Fit& tracked);
  void write_report(const Observation& seen);

  bool track_only_, contours_;
  Geometry geometry_;
  HeadFollow head_;
  FeatureTracker features_;
  LandmarkFollow landmarks_;
  PictureFit fit_;
  Workers workers_;  ///< for the starts of a fit
  Fit now_;          ///< of the last picture
  bool begun_ = false;
  PictureAnalysis report_;
};

}  // namespace fbs
