// Sources whose colours are not BT.709's: HDR, BT.2020 and P3. Part of the module fbs_av.
#pragma once

#include <optional>
#include <string>

#include "cli/video/av/av_support.h"

namespace fbs {

/// How frames become limited-range BT.709 of 8 bits.
struct ColourConversion {
  std::string graph;  ///< for fbs_avfilter (av_filter.h)
  std::string from;   ///< for the user: "HLG", "BT.2020"
  bool hdr = false;   ///< tone-mapped
};

/// @param frame   the first of `stream`
/// @return nothing for BT.601, BT.709, RGB and all that does not say what it is: those are encoded as they
///         are
std::optional<ColourConversion> colour_conversion(const AVStream& stream, const AVFrame& frame);

}  // namespace fbs
