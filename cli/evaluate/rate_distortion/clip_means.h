// The figures of one clip among several, and their means.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/evaluate/rate_distortion/clip_report.h"

namespace fbs::cli {

struct AreaFigures {
  std::optional<double> ours;     ///< luma PSNR of the shown point, dB
  std::optional<double> peers;    ///< of the peers' envelope at the same rate
  std::optional<double> bd_rate;  ///< percent
};

/// Figures at shown_point().
struct ClipFigures {
  std::string name;   ///< of the file, without folder and suffix
  std::string label;  ///< of the point
  std::optional<double> kbps, motion_kbps;
  AreaFigures face, frame;
};

[[nodiscard]] ClipFigures figures_of(const ClipReport& clip);

/// Over the clips that have one; nothing if none has.
[[nodiscard]] std::optional<double> mean_bd_rate(const std::vector<ClipReport>& clips, Area area);

/// "Over 3 clips, fbs needs 55 % less rate than the best of the other codecs for the same face, and ...";
/// empty without a mean.
[[nodiscard]] std::string means_sentence(const std::vector<ClipReport>& clips);

}  // namespace fbs::cli
