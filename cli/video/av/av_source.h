// Video files through libav. Part of the module fbs_av.
#pragma once

#include <memory>
#include <string>

#include "cli/video/av/av_support.h"
#include "cli/video/video_source.h"

namespace fbs {

/// Opens the main video stream of a file or address and decodes its first picture.
/// Timestamps are the container's, counted from its start. In containers that round them (Matroska to 1 ms),
/// times within one unit of the regular grid become exact.
Result<std::unique_ptr<VideoSource>> open_av_source(const std::string& input, const SourceOptions& options);

/// Time of the first picture that open_av_source returns for `input`, or the start of a container without
/// pictures; on the container's own clock, 1/AV_TIME_BASE s. Errors likewise.
/// @param container  `input`, opened
/// @param stop       interrupts reading; may be null
Result<std::int64_t> first_picture_time(AVFormatContext& container, const std::string& input,
                                        const StopSignal* stop);

}  // namespace fbs
