// Pictures of streams beside their source.
#pragma once

#include <string>
#include <vector>

#include "cli/evaluate/rate_distortion/clip_report.h"
#include "common/result.h"

namespace fbs::cli {

/// The same picture from the source, fbs, and another codec if there is one.
struct Still {
  std::size_t picture = 0;
  std::string why;  ///< "typical", "worst"
  struct Image {
    std::string jpeg;                ///< the file's bytes
    const RdPoint* point = nullptr;  ///< null: the source
  };
  std::vector<Image> images;
  std::string difference;  ///< of fbs from the source: luma, four times amplified, on black; JPEG
};

/// The pictures of the median and of the least PSNR of the face (of the frame, without a face) in
/// shown_point(). The pointers are into `clip`.
Result<std::vector<Still>> make_stills(const ClipReport& clip);

/// Writes them as `WHY-source.jpg`, `WHY-fbs.jpg`, `WHY-difference.jpg` and, for a rival, `WHY-x265.jpg`.
/// @param folder  created if needed
Result<void> write_stills(const std::string& folder, const std::vector<Still>& stills);

}  // namespace fbs::cli
