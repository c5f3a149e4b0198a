// The luma of a work frame, coarse to fine.
#pragma once

#include <array>

#include "encoder/fit/fit_tuning.h"
#include "encoder/image/bilinear.h"
#include "encoder/image/pyramid.h"
#include "encoder/image/work_frame.h"

namespace fbs {

/// Looked up by positions in the picture from which the frame was cut. Shares the frame's luma.
class LumaPyramid {
 public:
  LumaPyramid() = default;  ///< covers nothing
  /// @param levels  1..kFitLevels, the finest first; the others cover nothing
  explicit LumaPyramid(const WorkFrame& frame, int levels = kFitLevels);

  /// Value and slope per sample of the level.
  /// @param at_px  pixels of the picture
  /// @return false near the border of the level and outside
  [[nodiscard]] bool sample(int level, glm::dvec2 at_px, Sample& out) const {
    const glm::dvec2 work = (at_px - origin_) * scale_ - 0.5;
    return sample_with_slope(luma_[level], on_level(work, level), out);
  }

  /// Samples of a level per pixel of the picture.
  [[nodiscard]] double scale(int level) const { return scale_ / (1 << level); }

 private:
  double scale_ = 1;
  glm::dvec2 origin_{};
  Pyramid<kFitLevels> luma_;
};

}  // namespace fbs
