// Everything measured on one source, and conclusions from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/evaluate/rate_distortion/bd_rate.h"
#include "cli/evaluate/rate_distortion/rd_point.h"
#include "common/picture.h"

namespace fbs::cli {

struct ClipReport {
  std::string source;
  VideoFormat format;
  double seconds = 0;
  std::vector<double> times;    ///< of each picture, s
  std::string region_origin;    ///< "the mesh of quality 80", "faces.csv"
  std::size_t believed = 0;     ///< pictures with a face that is believed
  std::vector<RdPoint> points;  ///< streams of fbs
  std::vector<RdPoint> peers;   ///< streams of other codecs
  bool compared = false;        ///< with peers
  bool vmaf_available = false;
  bool whole = true;      ///< the source is neither cut off nor damaged
  std::string read_from;  ///< the source, or a copy of standard input
};

enum class Area : std::uint8_t { kFace, kFrame };

/// Luma PSNR, dB; nothing for a face that is in no picture.
[[nodiscard]] std::optional<double> psnr_of(const RdPoint& point, Area area);

/// Envelope of the points' luma PSNR over rate.
[[nodiscard]] Curve psnr_curve(const std::vector<RdPoint>& points, Area area);

/// BD-rate of the streams of fbs against the envelope of all peers.
[[nodiscard]] std::optional<RateDifference> bd_rate_against_peers(const ClipReport& clip, Area area);

/// The point for stills and the first sentence: the one of the middle rate. Null without points.
[[nodiscard]] const RdPoint* shown_point(const ClipReport& clip);

/// The peer with the best face (frame, where there is none) among those that take at most 2 % more than
/// `kbps`; if all take more, the one that takes least. Null without peers.
[[nodiscard]] const RdPoint* rival_of(const ClipReport& clip, double kbps);

/// The result in one or two sentences.
[[nodiscard]] std::string summary_of(const ClipReport& clip);

}  // namespace fbs::cli
