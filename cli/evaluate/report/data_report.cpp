#include "cli/evaluate/report/data_report.h"

#include <array>
#include <cstdio>
#include <span>

#include "cli/files/atomic_file.h"
#include "cli/stream/byte_count_json.h"

namespace fbs::cli {
namespace {

using nlohmann::json;

void add_area(const AreaSummary& area, const std::string& name, json& out) {
  if (area.pictures == 0) return;
  out["psnr_" + name] = area.y.psnr();
  out["psnr_u_" + name] = area.u.psnr();
  out["psnr_v_" + name] = area.v.psnr();
  out["ssim_" + name] = area.ssim;
  out["ms_ssim_" + name] = area.ms_ssim;
}

json point_json(const RdPoint& p) {
  json out = {{"point", p.label},
              {"frames", p.pictures.size()},
              {"seconds", p.seconds},
              {"kbps", p.kbps()},
              {"codec", p.codec}};
  if (p.codec == "fbs")
    out["bytes"] = byte_count_json(p.bytes);
  else
    out["bytes"] = {{"total", p.bytes.total}};
  if (p.bytes.sound > 0) out["sound_kbps"] = p.sound_kbps();
  const QualitySummary sum = summarise(p.pictures);
  add_area(sum.frame, "frame", out);
  add_area(sum.face, "face", out);
  if (p.vmaf) out["vmaf_frame"] = *p.vmaf;
  if (p.report) {
    out["cuts"] = p.report->cuts;
    out["frames_without_face"] = p.report->without_face;
  }
  return out;
}

json difference_json(const ClipReport& clip, Area area) {
  const auto d = bd_rate_against_peers(clip, area);
  if (!d) return nullptr;
  return {{"percent", d->percent}, {"from_db", d->low}, {"to_db", d->high}};
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string area_cells(const AreaQuality& a) {
  std::array<char, 128> text{};
  std::snprintf(text.data(), text.size(), ",%.4f,%.4f,%.4f,%.6f,%.6f", a.y.psnr(), a.u.psnr(), a.v.psnr(),
                a.ssim, a.ms_ssim);
  return text.data();
}

std::string csv_lines(const ClipReport& clip, const RdPoint& p) {
  std::string out;
  const std::string begin = csv_text(clip.source) + "," + csv_text(p.label) + ",";
  for (std::size_t n = 0; n < p.pictures.size(); ++n) {
    std::array<char, 64> time{};
    std::snprintf(time.data(), time.size(), "%zu,%.6f", n, n < clip.times.size() ? clip.times[n] : 0.0);
    const PictureQuality& q = p.pictures[n];
    out += begin + time.data() + area_cells(q.frame) +
           (q.face ? area_cells(*q.face) + "," + std::to_string(q.face->y.count) : ",,,,,,0") + "\n";
  }
  return out;
}

}  // namespace

json clip_json(const ClipReport& clip) {
  json points = json::array(), peers = json::array();
  for (const RdPoint& p : clip.points) points.push_back(point_json(p));
  for (const RdPoint& p : clip.peers) peers.push_back(point_json(p));
  json out = {{"source", clip.source},
              {"points", points},
              {"region", {{"from", clip.region_origin}, {"frames", clip.believed}}},
              {"vmaf", clip.vmaf_available ? "measured" : "not available"}};
  if (!clip.compared) return out;
  out["peers"] = peers;
  out["bd_rate"] = {{"face", difference_json(clip, Area::kFace)},
                    {"frame", difference_json(clip, Area::kFrame)}};
  return out;
}

Result<void> write_json(const std::string& file, const json& results) {
  auto out = AtomicFile::create(file);
  if (!out) return fail(out.error());
  const std::string text = results.dump(1) + "\n";
  return out->write(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())).and_then([&] {
    return out->commit();
  });
}

Result<void> write_csv(const std::string& file, const std::vector<ClipReport>& clips) {
  auto out = AtomicFile::create(file);
  if (!out) return fail(out.error());
  const auto write = [&](const std::string& text) {
    return out->write(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  };
  if (auto written = write("clip,point,picture,time_s,psnr_y,psnr_u,psnr_v,ssim,ms_ssim,"
                           "face_psnr_y,face_psnr_u,face_psnr_v,face_ssim,face_ms_ssim,face_samples\n");
      !written)
    return written;
  for (const ClipReport& clip : clips)
    for (const auto* points : {&clip.points, &clip.peers})
      for (const RdPoint& p : *points)
        if (auto written = write(csv_lines(clip, p)); !written) return written;
  return out->commit();
}

}  // namespace fbs::cli
