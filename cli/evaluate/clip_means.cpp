#include "cli/evaluate/clip_means.h"

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

}  // namespace fbs::cli
