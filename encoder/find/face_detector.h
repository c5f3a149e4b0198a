// Proposes where faces may be, with OpenCV's Haar cascades (Viola & Jones 2001).
#pragma once

#include <memory>
#include <vector>

#include "common/picture.h"
#include "common/result.h"
#include "encoder/landmarks/face_patch.h"

namespace fbs {

class FaceDetector {
 public:
  /// kIo when the cascades (Debian's opencv-data) are not found; the folder can be set with FBS_CASCADES.
  static Result<FaceDetector> create();

  /// Faces seen from the front, few of them wrong. Pictures that a face fills or that cut it off are
  /// included.
  [[nodiscard]] std::vector<FacePlace> likely(const Picture& picture) const;

  /// More cascades, which are believed sooner, in a larger picture: a few times slower, many of them wrong.
  /// Faces from the side and small ones are included.
  [[nodiscard]] std::vector<FacePlace> possible(const Picture& picture) const;

  /// Faces seen from the front with an eye distance between two bounds (pixels). The picture is scaled to
  /// suit the smallest: a fraction of the cost of likely().
  [[nodiscard]] std::vector<FacePlace> of_size(const Picture& picture, double min_eye_distance_px,
                                               double max_eye_distance_px) const;

 private:
  struct Cascades;
  struct Deleter {
    void operator()(Cascades* c) const;
  };
  explicit FaceDetector(std::unique_ptr<Cascades, Deleter> c) : cascades_(std::move(c)) {}
  std::unique_ptr<Cascades, Deleter> cascades_;
};

}  // namespace fbs
