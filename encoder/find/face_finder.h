// Finds faces and their eyes in a picture with OpenCV's Haar cascades (Viola & Jones 2001).
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

struct FoundFace {
  glm::dvec2 centre;               ///< of the detector's square, pixels
  double size = 0;                 ///< its side, pixels
  glm::dvec2 right_eye, left_eye;  ///< eye centres, pixels; right_eye is the subject's, at smaller x
  bool eyes_seen = false;          ///< both eyes were detected; otherwise they are placed by proportion
};

class FaceFinder {
 public:
  /// kIo when the cascades (Debian's opencv-data) are not found; the folder can be set with FBS_CASCADES.
  static Result<FaceFinder> create();

  /// Upright faces, the largest first. The picture is scaled to 480 rows or more first, where the cascades
  /// work.
  [[nodiscard]] std::vector<FoundFace> find(const Picture& picture) const;

  /// Upright faces with an eye distance between two bounds (pixels), the largest first; the eyes are placed
  /// by proportion. The picture is scaled to suit the smallest: a fraction of the cost of find().
  [[nodiscard]] std::vector<FoundFace> find_of_size(const Picture& picture, double min_eye_distance_px,
                                                    double max_eye_distance_px) const;

 private:
  struct Cascades;
  struct Deleter {
    void operator()(Cascades* c) const;
  };
  explicit FaceFinder(std::unique_ptr<Cascades, Deleter> c) : cascades_(std::move(c)) {}
  std::unique_ptr<Cascades, Deleter> cascades_;
};

}  // namespace fbs
