#include "cli/evaluate/report/html_tables.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "cli/evaluate/rate_distortion/clip_means.h"
#include "cli/evaluate/report/chart.h"

namespace fbs::cli {
namespace {

std::string cell(const std::string& text) {
  return "<td>" + text + "</td>";
}

std::string cell(std::optional<double> value, int digits) {
  return cell(value ? decimal(*value, digits) : "&ndash;");
}

/// Signed, with a minus as wide as a plus.
std::string percent_cell(std::optional<double> value) {
  if (!value) return cell("&ndash;");
  return cell((*value < 0 ? "&minus;" : "+") + decimal(std::abs(*value), 1) + "&thinsp;%");
}

std::string head(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += "<th>" + name + "</th>";
  return "<tr>" + out + "</tr>";
}

std::string table(const std::string& head_rows, const std::string& rows, const std::string& foot = "") {
  return "<div class=\"wide\"><table><thead>" + head_rows + "</thead><tbody>" + rows + "</tbody>" +
         (foot.empty() ? "" : "<tfoot>" + foot + "</tfoot>") + "</table></div>";
}

std::string area_cells(const AreaSummary& a) {
  const auto value = [&](double v) { return a.pictures > 0 ? std::optional(v) : std::nullopt; };
  return cell(value(a.y.psnr()), 2) + cell(value(a.u.psnr()), 1) + cell(value(a.v.psnr()), 1) +
         cell(value(a.ssim), 3) + cell(value(a.ms_ssim), 3);
}

std::string quality_cells(const RdPoint& p, bool vmaf) {
  const QualitySummary sum = summarise(p.pictures);
  return area_cells(sum.face) + area_cells(sum.frame) + (vmaf ? cell(p.vmaf, 1) : "");
}

/// The two header lines of a table of points; `columns` come before the qualities.
std::string quality_head(std::vector<std::string> columns, bool vmaf) {
  const std::string before = std::to_string(columns.size());
  for (int i = 0; i < 2; ++i)
    for (const char* name : {"Y, dB", "U", "V", "SSIM", "MS-SSIM"}) columns.emplace_back(name);
  if (vmaf) columns.emplace_back("VMAF");
  return "<tr><th colspan=\"" + before +
         "\"></th><th class=\"group\" colspan=\"5\">face</th><th class=\"group\" colspan=\"" +
         (vmaf ? "6" : "5") + "\">frame</th></tr>" + head(columns);
}

}  // namespace

std::string decimal(double value, int digits) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::string point_name(const RdPoint& point) {
  return point.label == point.file ? std::filesystem::path(point.file).filename().string() : point.label;
}

std::string point_table(const ClipReport& clip) {
  std::string rows;
  for (const RdPoint& p : clip.points) {
    rows += &p == shown_point(clip) && clip.points.size() > 1 ? "<tr class=\"shown\">" : "<tr>";
    rows += cell(escaped(point_name(p))) + cell(p.kbps(), 2) + cell(p.rate(p.bytes.motion), 2) +
            cell(std::to_string(p.bytes.startup)) + quality_cells(p, clip.vmaf_available) + "</tr>\n";
  }
  return table(quality_head({"", "kbit/s", "motion", "startup, bytes"}, clip.vmaf_available), rows);
}

std::string peer_table(const ClipReport& clip) {
  if (clip.peers.empty()) return "";
  std::string rows;
  for (const RdPoint& p : clip.peers)
    rows += "<tr>" + cell(escaped(p.label)) + cell(p.kbps(), 2) + quality_cells(p, clip.vmaf_available) +
            "</tr>\n";
  return "<details><summary>All points of the other codecs</summary>" +
         table(quality_head({"", "kbit/s"}, clip.vmaf_available), rows) + "</details>";
}

std::string clip_table(const std::vector<ClipReport>& clips) {
  std::string rows;
  for (const ClipReport& clip : clips) {
    const ClipFigures f = figures_of(clip);
    rows +=
        "<tr>" + cell(escaped(f.name)) + cell(escaped(f.label)) + cell(f.kbps, 2) + cell(f.motion_kbps, 2);
    for (const AreaFigures* a : {&f.face, &f.frame})
      rows += cell(a->ours, 2) + cell(a->peers, 2) + percent_cell(a->bd_rate);
    rows += "</tr>\n";
  }
  const auto face = mean_bd_rate(clips, Area::kFace), frame = mean_bd_rate(clips, Area::kFrame);
  const std::string foot = face || frame ? "<tr><td>mean</td><td colspan=\"5\"></td>" + percent_cell(face) +
                                               "<td colspan=\"2\"></td>" + percent_cell(frame) + "</tr>"
                                         : "";
  const std::string group =
      "<tr><th colspan=\"4\"></th><th class=\"group\" colspan=\"3\">face, luma</th><th class=\"group\" "
      "colspan=\"3\">frame, "
      "luma</th></tr>";
  const std::string names = head({"clip", "", "kbit/s", "motion", "fbs, dB", "others, dB", "BD-rate",
                                  "fbs, dB", "others, dB", "BD-rate"});
  return table(group + names, rows, foot);
}

}  // namespace fbs::cli
