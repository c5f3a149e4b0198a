#include "cli/evaluate/rate_distortion/clip_means.h"

#include <cmath>
#include <filesystem>

namespace fbs::cli {
namespace {

AreaFigures area_figures(const ClipReport& clip, const RdPoint& point, Area area) {
  AreaFigures out;
  out.ours = psnr_of(point, area);
  out.peers = quality_at(psnr_curve(clip.peers, area), point.kbps());
  if (const auto difference = bd_rate_against_peers(clip, area)) out.bd_rate = difference->percent;
  return out;
}

}  // namespace

ClipFigures figures_of(const ClipReport& clip) {
  ClipFigures out;
  out.name = std::filesystem::path(clip.source).stem().string();
  const RdPoint* point = shown_point(clip);
  if (point == nullptr) return out;
  out.label = point->label;
  out.kbps = point->kbps();
  out.motion_kbps = point->rate(point->bytes.motion);
  out.face = area_figures(clip, *point, Area::kFace);
  out.frame = area_figures(clip, *point, Area::kFrame);
  return out;
}

std::optional<double> mean_bd_rate(const std::vector<ClipReport>& clips, Area area) {
  double sum = 0;
  int count = 0;
  for (const ClipReport& clip : clips) {
    const auto difference = bd_rate_against_peers(clip, area);
    if (!difference) continue;
    sum += difference->percent;
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

std::string means_sentence(const std::vector<ClipReport>& clips) {
  std::string out;
  for (const Area area : {Area::kFace, Area::kFrame}) {
    const auto mean = mean_bd_rate(clips, area);
    if (!mean) continue;
    const std::string rate =
        std::to_string(std::lround(std::abs(*mean))) + " % " + (*mean < 0 ? "less" : "more") + " rate";
    if (out.empty())
      out = "Over " + std::to_string(clips.size()) + " clips, fbs needs " + rate +
            " than the best of the other codecs";
    else
      out += " and " + rate;
    out += area == Area::kFace ? " for the same face" : " for the same frame";
  }
  return out.empty() ? out : out + " (mean BD-rate of luma PSNR).";
}

}  // namespace fbs::cli
