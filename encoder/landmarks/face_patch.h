// A face's surroundings in a picture, brought to one size: what landmarks are searched in.
#pragma once

#include <glm/vec2.hpp>
#include <opencv2/core.hpp>

#include "encoder/landmarks/shape.h"

namespace fbs {

/// Where an upright face is thought to be, pixels of the picture.
struct FacePlace {
  glm::dvec2 centre;         ///< mean of its 68 landmarks
  double eye_distance_px{};  ///< between the centres of its eyes
};

/// Of a face whose landmarks are known.
[[nodiscard]] FacePlace place_of(const Shape& landmarks);

inline constexpr int kPatchSide = 288;          ///< pixels
inline constexpr float kPatchEyeDistance = 64;  ///< of the face that is thought to be in it, pixels

class FacePatch {
 public:
  /// Where the picture ends, its border is repeated.
  /// @param picture  luma, 8 bits
  FacePatch(const cv::Mat& picture, const FacePlace& place);

  [[nodiscard]] const cv::Mat1b& luma() const { return luma_; }

  /// Between positions in the picture and in the patch.
  [[nodiscard]] glm::vec2 to_patch(glm::dvec2 p) const { return glm::vec2((p - corner_) * scale_); }
  [[nodiscard]] glm::dvec2 to_picture(glm::vec2 p) const { return glm::dvec2(p) / scale_ + corner_; }

 private:
  glm::dvec2 corner_;  ///< of the patch in the picture
  double scale_;       ///< patch pixels for a pixel of the picture
  cv::Mat1b luma_;
};

}  // namespace fbs
