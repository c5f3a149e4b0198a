// MP4 and Matroska files with H.264 video through libav. Part of the module fbs_av.
#pragma once

#include <memory>
#include <string>

#include "cli/video/video_sink.h"

namespace fbs {

/// Uses x264 (CRF 12, preset veryfast), or MPEG-4 part 2 when libav was built without it. Times are exact in
/// MP4 and rounded to 1 ms by Matroska. Sound is copied without re-encoding, up to the end of the pictures.
Result<std::unique_ptr<VideoSink>> open_av_sink(const std::string& output, const VideoFormat& format,
                                                const SinkOptions& options);

}  // namespace fbs
