// Motion of the whole picture: how a camera pans, rolls and zooms.
#pragma once

#include <complex>
#include <glm/vec2.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/picture.h"
#include "encoder/surround/keypoint.h"
#include "encoder/surround/similarity.h"

namespace fbs {

/// A similarity of the plane about the middle of the picture: z -> turn * z + shift, pixels.
struct PlaneMotion {
  std::complex<double> turn{1, 0};  ///< scale and rotation
  std::complex<double> shift{0, 0};

  /// This motion, then another one.
  [[nodiscard]] PlaneMotion then(const PlaneMotion& next) const {
    return {next.turn * turn, next.turn * shift + next.shift};
  }
};

/// Aligns each picture to an anchor, an earlier picture that shows much of the same, by its steepest places.
/// Where the picture has left its anchor it becomes the next one.
class GlobalMotion {
 public:
  struct Observation {
    PlaneMotion since_first;      ///< from the first picture to this one
    double moved = 0, still = 0;  ///< mean robust squared luma difference to the anchor, so moved and unmoved
    /// What a place sees of the picture: place from the middle, pixels, and the structure of its square.
    struct Place {
      glm::dvec2 at;
      std::array<float, 3> structure;  ///< sums of dx dx, dx dy, dy dy
    };
    std::vector<Place> places;
  };
  /// The next picture; all have one size.
  [[nodiscard]] Observation observe(const Picture& picture);

  /// The next picture begins another shot, where motion so far is held.
  void cut() { keypoints_.clear(); }

 private:
  void set_anchor(const PlaneMotion& since_first);
  /// Displacement that would bring the last picture's content to this one's, work pixels.
  [[nodiscard]] glm::dvec2 correlated(const SurroundPyramid& before) const;

  int factor_ = 1;  ///< pixels per work pixel
  glm::dvec2 middle_{};
  double unit_px_ = 1;
  SurroundPyramid luma_;             ///< of the last picture
  std::vector<Keypoint> keypoints_;  ///< of the anchor; none: the next picture is one
  PlaneMotion anchor_;               ///< from the first picture to the anchor
  Similarity now_{};                 ///< from the anchor to the last picture
  Similarity velocity_{};            ///< in the last picture
};

}  // namespace fbs
