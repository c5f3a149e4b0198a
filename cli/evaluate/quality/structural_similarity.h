// SSIM and MS-SSIM of two planes, with OpenCV.
#pragma once

#include "common/picture.h"

namespace fbs::cli {

struct StructuralSimilarity {
  double ssim = 0;     ///< -1..1
  double ms_ssim = 0;  ///< 0..1
};

/// SSIM: Wang, Bovik, Sheikh and Simoncelli, *Image Quality Assessment*, 2004: an 11 x 11 Gaussian of sigma
/// 1.5, borders reflected.
/// MS-SSIM: Wang, Simoncelli and Bovik, *Multiscale Structural Similarity for Image Quality Assessment*,
/// 2003, with their five weights; a scale is the mean of 2 x 2 samples of the one before. Differs: borders
/// are reflected, and scales at which a side would be shorter than the window's 11 samples are left out, the
/// other weights taking their share; so small faces and QCIF have a value, which should not be compared with
/// those of larger pictures.
/// @param a, b  of the same size, not empty
[[nodiscard]] StructuralSimilarity structural_similarity(const Plane& a, const Plane& b);

/// Number of MS-SSIM scales for a plane of this size: 1 to 5.
[[nodiscard]] int ms_ssim_scales(int width, int height);

}  // namespace fbs::cli
