// Owners of libav's objects and its error texts. Part of the module fbs_av.
#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/error.h>
#include <libswscale/swscale.h>
}

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "cli/files/stop_signal.h"
#include "cli/video/timestamps.h"

namespace fbs {

struct AvDeleter {
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* context) const { sws_freeContext(context); }
};
using AvCodec = std::unique_ptr<AVCodecContext, AvDeleter>;
using AvFrame = std::unique_ptr<AVFrame, AvDeleter>;
using AvPacket = std::unique_ptr<AVPacket, AvDeleter>;
using AvScaler = std::unique_ptr<SwsContext, AvDeleter>;

struct AvInputDeleter {
  void operator()(AVFormatContext* context) const { avformat_close_input(&context); }
};
using AvInput = std::unique_ptr<AVFormatContext, AvInputDeleter>;

inline constexpr AVRational kTick{1, static_cast<int>(kTicksPerSecond)};

/// libav's AV_TIME_BASE_Q is not valid C++.
inline constexpr AVRational kTimeBase{1, AV_TIME_BASE};

/// libav's text for one of its codes.
inline std::string av_reason(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

/// Number of errors that demuxers have logged since the program began: for some faults, such as the sudden
/// end of a Matroska file, the only sign.
[[nodiscard]] std::int64_t demuxer_complaints();

/// Opens a container for reading and finds its streams. A local file wins over an address of the same
/// spelling.
/// @param stop  interrupts opening and reading; may be null
/// @return null when it fails, with libav's code in `error`
AvInput open_av_input(const std::string& name, const StopSignal* stop, int& error);

/// Makes the demuxer skip all streams but one.
void discard_others(AVFormatContext& container, int index);

}  // namespace fbs
