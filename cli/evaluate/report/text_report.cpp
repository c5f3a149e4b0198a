#include "cli/evaluate/report/text_report.h"

#include <array>
#include <cstdio>
#include <string>

#include "cli/evaluate/rate_distortion/clip_means.h"
#include "cli/source/encode_session.h"

namespace fbs::cli {
namespace {

constexpr int kNameWidth = 20;

std::string number(std::optional<double> value, int width, int digits) {
  std::array<char, 48> text{};
  if (value)
    std::snprintf(text.data(), text.size(), " %*.*f", width, digits, *value);
  else
    std::snprintf(text.data(), text.size(), " %*s", width, "-");
  return text.data();
}

std::optional<double> if_any(const AreaSummary& area, double value) {
  return area.pictures > 0 ? std::optional(value) : std::nullopt;
}

void print_point(const RdPoint& p) {
  const QualitySummary sum = summarise(p.pictures);
  const auto b = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
  std::printf("%-*s %8.3f %7.3f %8llu %8llu %8llu %6llu %8llu", kNameWidth, p.label.c_str(), p.kbps(),
              p.rate(p.bytes.motion), b(p.bytes.startup), b(p.bytes.geometry), b(p.bytes.patterns),
              b(p.bytes.other), b(p.bytes.total - p.bytes.sound));
  for (const AreaSummary* area : {&sum.face, &sum.frame})
    std::printf("%s%s%s", number(if_any(*area, area->y.psnr()), 8, 2).c_str(),
                number(if_any(*area, area->ssim), 6, 4).c_str(),
                number(if_any(*area, area->ms_ssim), 7, 4).c_str());
  if (p.vmaf) std::printf(" %6.2f", *p.vmaf);
  std::printf("\n");
  if (p.bytes.sound > 0)
    std::printf("  sound beside the pictures: %llu bytes, %.3f kbit/s\n", b(p.bytes.sound), p.sound_kbps());
  if (const std::string notes = p.report ? notes_of(*p.report) : ""; !notes.empty())
    std::printf("  %s\n", notes.c_str());
}

void print_differences(const ClipReport& clip) {
  if (!clip.compared) return;
  std::printf("%s\n", summary_of(clip).c_str());
  for (const Area area : {Area::kFace, Area::kFrame})
    if (!bd_rate_against_peers(clip, area))
      std::printf("no BD-rate of the %s: it takes four points of each and qualities that both reach\n",
                  area == Area::kFace ? "face" : "frame");
}

}  // namespace

void print_clip(const ClipReport& clip) {
  std::printf("%-*s %8s %7s %8s %8s %8s %6s %8s %8s %6s %7s %8s %6s %7s%s\n", kNameWidth, "", "kbit/s",
              "motion", "startup", "geometry", "patterns", "other", "total B", "face dB", "SSIM", "MS-SSIM",
              "frame dB", "SSIM", "MS-SSIM", clip.vmaf_available ? "   VMAF" : "");
  for (const RdPoint& p : clip.points) print_point(p);
  const std::size_t pictures = clip.times.size();
  if (clip.points.size() > 1 || clip.compared || clip.believed < pictures)
    std::printf("face: %s, in %zu of %zu pictures\n", clip.region_origin.c_str(), clip.believed, pictures);
  print_differences(clip);
}

void print_clips(const std::vector<ClipReport>& clips) {
  std::printf("%-*s %9s %9s %8s %8s %8s %8s %12s %12s\n", kNameWidth, "", "kbit/s", "motion", "face Y",
              "peers", "frame Y", "peers", "face BD-rate", "frame");
  for (const ClipReport& clip : clips) {
    const ClipFigures f = figures_of(clip);
    std::printf("%-*s%s%s%s%s%s%s%s%s\n", kNameWidth, f.name.c_str(), number(f.kbps, 9, 3).c_str(),
                number(f.motion_kbps, 9, 3).c_str(), number(f.face.ours, 8, 2).c_str(),
                number(f.face.peers, 8, 2).c_str(), number(f.frame.ours, 8, 2).c_str(),
                number(f.frame.peers, 8, 2).c_str(), number(f.face.bd_rate, 12, 1).c_str(),
                number(f.frame.bd_rate, 12, 1).c_str());
  }
  const auto face = mean_bd_rate(clips, Area::kFace), frame = mean_bd_rate(clips, Area::kFrame);
  if (face || frame)
    std::printf("%-*s%*s%s%s\n", kNameWidth, "mean", 56, "", number(face, 12, 1).c_str(),
                number(frame, 12, 1).c_str());
}

}  // namespace fbs::cli
