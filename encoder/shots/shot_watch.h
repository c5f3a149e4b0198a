// What the shots of a video ask of its scenes: where to look for a face, and where a scene must begin.
#pragma once

#include <cstdint>
#include <optional>

#include "common/picture.h"
#include "encoder/shots/cut_detector.h"
#include "encoder/shots/fade_in.h"

namespace fbs {

/// For each picture: see(), next(), then where it says so a search and scene_begins(), begin_scene() if one
/// begins, and end_picture().
class ShotWatch {
 public:
  /// @param fps  pictures per second
  explicit ShotWatch(double fps) : fps_(fps) {}

  /// What to do ahead of a picture.
  struct Step {
    bool cut = false;         ///< it begins another shot
    bool searches = false;    ///< look for a face
    bool recognises = false;  ///< but ask the scene first whether it recognises whom it follows
    bool all_sizes = false;   ///< look for small faces, too
  };
  /// Compares the next picture with the one before; all have one size. May precede end_picture() of that one.
  void see(const Picture& picture) { cut_ = cuts_.is_cut(picture); }
  /// For the picture seen last.
  [[nodiscard]] Step next();

  /// The picture shows whom the scene follows.
  void recognised() { follows_ = true; }
  /// Whether a scene must begin with the picture. To be asked once after a search.
  /// @param face  whether one was found
  [[nodiscard]] bool scene_begins(bool face);

  struct SceneTraits {
    bool has_face;
    bool carries_shots;  ///< of anything else, too
  };
  /// A scene begins with the picture.
  void begin_scene(const SceneTraits& scene);

  /// @param followed  whether the scene's face was followed in the picture
  void end_picture(bool followed);

 private:
  [[nodiscard]] bool lasts(std::uint64_t pictures, double seconds) const {
    return pictures >= static_cast<std::uint64_t>(seconds * fps_);
  }

  double fps_;
  CutDetector cuts_;
  FadeIn fade_in_;
  std::optional<SceneTraits> scene_;
  bool cut_ = false, faded_in_ = false;  ///< at this picture
  bool cut_to_ = false;                  ///< the shot began with a cut
  bool follows_ = false;                 ///< the shot shows whom the scene follows
  std::uint64_t in_shot_ = 0;            ///< pictures before this one
  std::uint64_t lost_ = 0;  ///< pictures, the last ones, in which the scene's face was not followed
};

}  // namespace fbs
