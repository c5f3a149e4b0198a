#include "cli/evaluate/report/clip_charts.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "cli/evaluate/report/chart.h"
#include "cli/evaluate/report/html_tables.h"

namespace fbs::cli {
namespace {

constexpr double kMostShown = 60;             // dB; equal pictures have 99
constexpr std::size_t kMostTimePoints = 400;  // a line with more is a band of noise

std::string style_of(const std::string& codec) {
  std::string out = codec;
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

/// "quality 50" as "50", "6 kbit/s" as it is.
std::string short_label(const std::string& label) {
  if (label.ends_with(" kbit/s")) return label;
  return label.starts_with("quality ") ? label.substr(8) : "";
}

std::vector<RdPoint> only(const std::vector<RdPoint>& points, const std::string& codec) {
  std::vector<RdPoint> out;
  for (const RdPoint& p : points)
    if (p.codec == codec) out.push_back(p);
  return out;
}

ChartSeries curve_series(const Curve& curve, std::string name, std::string style) {
  ChartSeries out{std::move(name), std::move(style), {}};
  for (const CurvePoint& p : curve) out.points.push_back({p.kbps, p.quality, ""});
  return out;
}

const char* title_of(Area area) {
  return area == Area::kFace ? "PSNR of the face" : "PSNR of the frame";
}

/// Averages over a few pictures where there are many.
ChartSeries time_series(const ClipReport& clip, const RdPoint& point, Area area) {
  ChartSeries out{point.codec, style_of(point.codec) + " time", {}, true, false};
  const std::size_t group = point.pictures.size() / kMostTimePoints + 1;
  for (std::size_t begin = 0; begin < point.pictures.size(); begin += group) {
    SquaredError sum;
    for (std::size_t n = begin; n < std::min(begin + group, point.pictures.size()); ++n) {
      const PictureQuality& q = point.pictures[n];
      if (area == Area::kFrame)
        sum += q.frame.y;
      else if (q.face)
        sum += q.face->y;
    }
    if (sum.count > 0 && begin < clip.times.size())
      out.points.push_back({clip.times[begin], std::min(sum.psnr(), kMostShown), ""});
  }
  return out;
}

}  // namespace

std::string rate_chart(const ClipReport& clip, Area area) {
  std::vector<ChartSeries> series;
  if (!clip.peers.empty()) {
    series.push_back(curve_series(psnr_curve(clip.peers, area), "", "envelope"));
    series.back().markers = false;
  }
  for (const char* codec : {"x264", "x265", "AV1"})
    if (const auto points = only(clip.peers, codec); !points.empty())
      series.push_back(curve_series(psnr_curve(points, area), codec, style_of(codec)));
  ChartSeries ours{"fbs", "fbs", {}};
  for (const RdPoint& p : clip.points)
    if (const auto psnr = psnr_of(p, area)) ours.points.push_back({p.kbps(), *psnr, short_label(p.label)});
  std::sort(ours.points.begin(), ours.points.end(),
            [](const ChartPoint& a, const ChartPoint& b) { return a.x < b.x; });
  series.push_back(std::move(ours));
  return line_chart({title_of(area) + std::string(" over bitrate"), "kbit/s", "dB", true}, series);
}

std::string time_chart(const ClipReport& clip, Area area) {
  const RdPoint* point = shown_point(clip);
  if (point == nullptr) return "";
  std::vector<ChartSeries> series;
  if (const RdPoint* rival = rival_of(clip, point->kbps()); rival != nullptr)
    series.push_back(time_series(clip, *rival, area));
  series.push_back(time_series(clip, *point, area));
  return line_chart({title_of(area) + std::string(" over time"), "seconds", "dB", false}, series);
}

std::string time_rival_text(const ClipReport& clip) {
  const RdPoint* point = shown_point(clip);
  if (point == nullptr) return "";
  std::string out = ", fbs at " + decimal(point->kbps(), 1) + " kbit/s";
  if (const RdPoint* rival = rival_of(clip, point->kbps()); rival != nullptr)
    out += ", " + rival->codec + " at " + decimal(rival->kbps(), 1);
  return out;
}

std::string byte_bars(const ClipReport& clip) {
  std::uint64_t most = 1;
  for (const RdPoint& p : clip.points) most = std::max(most, p.bytes.total);
  std::string out;
  for (const RdPoint& p : clip.points) {
    out += "<span class=\"bar-name\">" + escaped(point_name(p)) + "</span><span class=\"bar\">";
    for (const auto& [style, bytes] :
         {std::pair{"geometry", p.bytes.geometry}, std::pair{"patterns", p.bytes.patterns},
          std::pair{"motion", p.bytes.motion}, std::pair{"sound", p.bytes.sound},
          std::pair{"other", p.bytes.other}})
      out += std::string("<i class=\"") + style + "\" title=\"" + style + ": " + std::to_string(bytes) +
             " bytes\" style=\"width: " +
             decimal(100 * static_cast<double>(bytes) / static_cast<double>(most), 2) + "%\"></i>";
    out += "</span><span class=\"bar-bytes\">" + std::to_string(p.bytes.total) + " bytes</span>\n";
  }
  return "<div class=\"bars\">" + out + "</div>";
}

}  // namespace fbs::cli
