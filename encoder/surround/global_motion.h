// Motion of the whole picture as a camera pans, rolls and zooms.
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

  /// This motion followed by another.
  [[nodiscard]] PlaneMotion then(const PlaneMotion& next) const {
    return {next.turn * turn, next.turn * shift + next.shift};
  }
};

/// Aligns each picture to an anchor, an earlier picture with much of the same content, by its steepest
/// places. When the picture has moved too far from its anchor it becomes the next one.
class GlobalMotion {
 public:
  struct Observation {
    PlaneMotion since_first;  ///< from the first picture to this one
    double moved = 0,
           still = 0;  ///< mean robust squared luma difference to the anchor, with and without motion
    /// A place of the picture: relative to the middle, pixels, with the structure of its square.
    struct Place {
      glm::dvec2 at;
      std::array<float, 3> structure;  ///< sums of dx dx, dx dy, dy dy
    };
    std::vector<Place> places;
  };
  /// Adds the next picture; all have one size.
  [[nodiscard]] Observation observe(const Picture& picture);

  /// The next picture begins another shot, which starts with the motion so far.
  void cut() { keypoints_.clear(); }

 private:
  void set_anchor(const PlaneMotion& since_first);
  /// Displacement from the last picture's content to this one's, work pixels.
  [[nodiscard]] glm::dvec2 correlated(const SurroundPyramid& before) const;

  int factor_ = 1;  ///< pixels per work pixel
  glm::dvec2 middle_{};
  double unit_px_ = 1;
  SurroundPyramid luma_;             ///< of the last picture
  std::vector<Keypoint> keypoints_;  ///< of the anchor; none: the next picture becomes one
  PlaneMotion anchor_;               ///< from the first picture to the anchor
  Similarity now_{};                 ///< from the anchor to the last picture
  Similarity velocity_{};            ///< in the last picture
};

}  // namespace fbs
