// The charts of one clip in the report: curves as SVG, bars as HTML.
#pragma once

#include <string>

#include "cli/evaluate/rate_distortion/clip_report.h"

namespace fbs::cli {

/// PSNR over rate: fbs, each other codec, and the envelope of those.
[[nodiscard]] std::string rate_chart(const ClipReport& clip, Area area);

/// PSNR over time of shown_point() and its rival.
[[nodiscard]] std::string time_chart(const ClipReport& clip, Area area);

/// A text such as ", fbs at 4.2 kbit/s, AV1 at 4.1 kbit/s".
[[nodiscard]] std::string time_rival_text(const ClipReport& clip);

/// Bytes of each stream of fbs by part.
[[nodiscard]] std::string byte_bars(const ClipReport& clip);

}  // namespace fbs::cli
