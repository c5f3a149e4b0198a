// A face's surroundings in a picture, scaled to one size for the landmark search.
#pragma once

#include <glm/vec2.hpp>
#include <opencv2/core.hpp>

#include "encoder/landmarks/shape.h"

namespace fbs {

/// Supposed place of an upright face, pixels of the picture.
struct FacePlace {
  glm::dvec2 centre;         ///< mean of its 68 landmarks
  double eye_distance_px{};  ///< between the centres of its eyes
};

/// The place of a face whose landmarks are known.
[[nodiscard]] FacePlace place_of(const Shape& landmarks);

inline constexpr int kPatchSide = 288;          ///< pixels
inline constexpr float kPatchEyeDistance = 64;  ///< of the face supposed in it, pixels

class FacePatch {
 public:
  /// Repeats the picture's border beyond it.
  /// @param picture  luma, 8 bits
  FacePatch(const cv::Mat& picture, const FacePlace& place);

  [[nodiscard]] const cv::Mat1b& luma() const { return luma_; }

  /// Convert between positions in the picture and in the patch.
  [[nodiscard]] glm::vec2 to_patch(glm::dvec2 p) const { return glm::vec2((p - corner_) * scale_); }
  [[nodiscard]] glm::dvec2 to_picture(glm::vec2 p) const { return glm::dvec2(p) / scale_ + corner_; }

 private:
  glm::dvec2 corner_;  ///< of the patch in the picture
  double scale_;       ///< patch pixels for a pixel of the picture
  cv::Mat1b luma_;
};

}  // namespace fbs
