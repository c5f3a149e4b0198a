// Compares a shown picture with its source: the whole frame, and the face in it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "cli/source/face_outline.h"
#include "common/picture.h"
#include "common/quality.h"

namespace fbs::cli {

/// Quality of one area of one picture.
struct AreaQuality {
  SquaredError y, u, v;
  double ssim = 0, ms_ssim = 0;  ///< luma; for a face, over its bounding box

  friend bool operator==(const AreaQuality&, const AreaQuality&) = default;
};

struct PictureQuality {
  AreaQuality frame;
  std::optional<AreaQuality> face;  ///< nothing if the picture has no face

  friend bool operator==(const PictureQuality&, const PictureQuality&) = default;
};

/// @param source, shown  of the same size
/// @param face  empty: no face
[[nodiscard]] PictureQuality compare_pictures(const Picture& source, const Picture& shown,
                                              const FaceOutline& face);

/// Summary of an area over many pictures.
struct AreaSummary {
  std::uint64_t pictures = 0;    ///< pictures that have the area
  SquaredError y, u, v;          ///< sums: PSNR is computed from the mean squared error
  double ssim = 0, ms_ssim = 0;  ///< means over the pictures; 0 without any
};

struct QualitySummary {
  AreaSummary frame, face;
};

[[nodiscard]] QualitySummary summarise(std::span<const PictureQuality> pictures);

}  // namespace fbs::cli
