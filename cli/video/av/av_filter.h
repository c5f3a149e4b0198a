// The interface of the module fbs_avfilter: frames through a graph of libavfilter. A module of its own, since
// few sources need one and loading libavfilter takes longer than all of fbs_av.
#pragma once

#include <memory>
#include <string>

#include "cli/video/av/av_support.h"
#include "common/result.h"

namespace fbs {

/// A graph that returns a frame for each frame.
class FrameFilter {
 public:
  virtual ~FrameFilter() = default;

  /// @param frame  of the size and pixel format of the first one
  /// @return the filtered frame, valid until the next call; kUnsupported when a filter fails
  virtual Result<const AVFrame*> filter(const AVFrame& frame) = 0;
};

inline constexpr const char* kAvFilterModule = "fbs_avfilter";
inline constexpr const char* kOpenFilterSymbol = "fbs_open_filter";

/// Sets `filter`; kUnsupported when libavfilter lacks one of the filters.
/// @param first  has the size, pixel format and pixel aspect of all frames
/// @param graph  in the syntax of ffmpeg -vf
using OpenFilterFunction = void(const AVFrame& first, const std::string& graph,
                                Result<std::unique_ptr<FrameFilter>>& filter);

}  // namespace fbs
