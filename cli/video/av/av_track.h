// One stream of a container, and its decoder. Part of the module fbs_av.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "cli/video/av/av_support.h"
#include "common/result.h"

namespace fbs {

class AvTrack {
 public:
  /// @param name  of the container
  explicit AvTrack(std::string name) : name_(std::move(name)) {}

  /// Opens the container: open_av_input().
  /// @return libav's code, negative when it fails
  int open(const StopSignal* stop);
  /// Decodes one of its streams from now on; the others are skipped.
  /// @param kind  for errors: "video" or "sound"
  Result<void> choose(int index, const AVCodec& codec, int threads, const std::string& kind);
  /// Decodes the next frame.
  /// @return false at the end; kTruncated or kIo where reading has ended early, once all that was read is
  /// decoded
  Result<bool> decode();

  [[nodiscard]] AVFormatContext& container() const { return *container_; }
  [[nodiscard]] AVStream& stream() const { return *stream_; }
  /// As decode() left it.
  [[nodiscard]] AVFrame& frame() const { return *frame_; }
  /// When it begins on the container's clock, in a unit; nothing if the container does not say.
  [[nodiscard]] std::optional<std::int64_t> frame_time(AVRational unit) const;
  /// Packets that could not be decoded.
  [[nodiscard]] std::int64_t damaged_packets() const { return damaged_packets_; }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] tl::unexpected<Error> error(ErrorCode code, const std::string& text) const {
    return fail(code, name_ + ": " + text);
  }

 private:
  /// Sends the next packet, or the end, to the decoder.
  Result<void> feed();
  /// @param code  libav's, at the end of the container
  /// @param cut   whether it came too early
  void note_failure(int code, bool cut);

  std::string name_;
  AvInput container_;
  AvCodec decoder_;
  AvPacket packet_{av_packet_alloc()};
  AvFrame frame_{av_frame_alloc()};
  AVStream* stream_ = nullptr;    ///< of container_
  bool drained_ = false;          ///< the decoder has got its end-of-stream packet
  std::optional<Error> failure_;  ///< what ended the container early
  std::int64_t damaged_packets_ = 0;
  bool last_packet_cut_ = false;  ///< libav read less of it than expected
};

}  // namespace fbs
