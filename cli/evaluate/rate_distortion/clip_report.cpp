#include "cli/evaluate/rate_distortion/clip_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace fbs::cli {
namespace {

constexpr double kSameRate = 1.02;

std::string fixed(double value, int digits) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

const char* name_of(Area area) {
  return area == Area::kFace ? "face" : "frame";
}

/// Names such as "x264, x265 and AV1", of the peers present.
std::string names_of(const std::vector<RdPoint>& peers) {
  std::vector<std::string> names;
  for (const RdPoint& p : peers)
    if (names.empty() || names.back() != p.codec) names.push_back(p.codec);
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return out;
}

/// A phrase such as "2.9 dB better (29.5 against 26.6 dB)".
std::string better(double ours, double theirs) {
  const double difference = ours - theirs;
  const std::string both = " (" + fixed(ours, 1) + " against " + fixed(theirs, 1) + " dB)";
  if (std::abs(difference) < 0.05) return "as good as theirs" + both;
  return fixed(std::abs(difference), 1) + " dB " + (difference > 0 ? "better" : "worse") + both;
}

std::string own_sentence(const RdPoint& point) {
  std::string out = "At " + fixed(point.kbps(), 1) + " kbit/s (" + point.label + ") ";
  if (const auto face = psnr_of(point, Area::kFace)) out += "the face has " + fixed(*face, 1) + " dB and ";
  return out + "the frame " + fixed(psnr_of(point, Area::kFrame).value_or(0), 1) + " dB of luma PSNR.";
}

/// Compares at the rate of `point` with the envelope of the peers.
std::string sentence_at_rate(const ClipReport& clip, const RdPoint& point) {
  std::string out = "At " + fixed(point.kbps(), 1) + " kbit/s (" + point.label +
                    "), compared with the best of " + names_of(clip.peers) + ",";
  const char* joint = " the ";
  for (const Area area : {Area::kFace, Area::kFrame}) {
    const auto ours = psnr_of(point, area), theirs = quality_at(psnr_curve(clip.peers, area), point.kbps());
    if (!ours || !theirs) continue;
    out += joint + std::string(name_of(area)) + " is " + better(*ours, *theirs);
    joint = " and the ";
  }
  return out + ".";
}

std::string rate_sentence(const ClipReport& clip, Area area) {
  const auto difference = bd_rate_against_peers(clip, area);
  if (!difference) return "";
  return " For the same " + std::string(name_of(area)) + " it needs " +
         fixed(std::abs(difference->percent), 0) + " % " + (difference->percent < 0 ? "less" : "more") +
         " rate (BD-rate, " + fixed(difference->low, 0) + " to " + fixed(difference->high, 0) + " dB).";
}

}  // namespace

std::optional<double> psnr_of(const RdPoint& point, Area area) {
  const QualitySummary sum = summarise(point.pictures);
  const AreaSummary& of_area = area == Area::kFace ? sum.face : sum.frame;
  if (of_area.y.count == 0) return std::nullopt;
  return of_area.y.psnr();
}

Curve psnr_curve(const std::vector<RdPoint>& points, Area area) {
  std::vector<CurvePoint> out;
  for (const RdPoint& p : points)
    if (const auto psnr = psnr_of(p, area); psnr && p.kbps() > 0) out.push_back({p.kbps(), *psnr});
  return envelope(out);
}

std::optional<RateDifference> bd_rate_against_peers(const ClipReport& clip, Area area) {
  return bd_rate(psnr_curve(clip.peers, area), psnr_curve(clip.points, area));
}

const RdPoint* shown_point(const ClipReport& clip) {
  std::vector<const RdPoint*> sorted;
  for (const RdPoint& p : clip.points) sorted.push_back(&p);
  std::sort(sorted.begin(), sorted.end(),
            [](const RdPoint* a, const RdPoint* b) { return a->kbps() < b->kbps(); });
  return sorted.empty() ? nullptr : sorted[(sorted.size() - 1) / 2];
}

const RdPoint* rival_of(const ClipReport& clip, double kbps) {
  const auto quality = [](const RdPoint& p) {
    const auto face = psnr_of(p, Area::kFace);
    return face ? *face : psnr_of(p, Area::kFrame).value_or(0);
  };
  const RdPoint *best = nullptr, *least = nullptr;
  for (const RdPoint& p : clip.peers) {
    if (least == nullptr || p.kbps() < least->kbps()) least = &p;
    if (p.kbps() <= kSameRate * kbps && (best == nullptr || quality(p) > quality(*best))) best = &p;
  }
  return best != nullptr ? best : least;
}

std::string summary_of(const ClipReport& clip) {
  const RdPoint* point = shown_point(clip);
  if (point == nullptr) return "";
  if (!clip.compared || clip.peers.empty()) return own_sentence(*point);
  const Curve frame = psnr_curve(clip.peers, Area::kFrame);
  std::string out;
  if (point->kbps() < frame.front().kbps)
    out = own_sentence(*point) + " None of " + names_of(clip.peers) +
          " goes that low: the least of them takes " + fixed(frame.front().kbps, 1) +
          " kbit/s for a frame of " + fixed(frame.front().quality, 1) + " dB.";
  else
    out = sentence_at_rate(clip, *point);
  return out + rate_sentence(clip, Area::kFace) + rate_sentence(clip, Area::kFrame);
}

}  // namespace fbs::cli
