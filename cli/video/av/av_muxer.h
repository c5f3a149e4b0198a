// A libav container written through AtomicFile. Part of the module fbs_av.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "cli/files/atomic_file.h"
#include "cli/video/av/av_support.h"

namespace fbs {

/// Errors are ErrorCode::kIo with the system's reason when the file failed, else with libav's.
class AvMuxer {
 public:
  /// @param container  libav's name, "mp4" or "matroska"
  static Result<std::unique_ptr<AvMuxer>> create(const std::string& output, const char* container);
  ~AvMuxer();
  AvMuxer(const AvMuxer&) = delete;
  AvMuxer& operator=(const AvMuxer&) = delete;

  /// Owned by the muxer; all streams are added before write_header.
  AVStream* add_stream();
  [[nodiscard]] const AVOutputFormat& container() const { return *context_->oformat; }

  /// Added to the times of a sound track, 1/48000 s. In Matroska they are later by CodecDelay, which players
  /// subtract; up to version 5.1 ffmpeg writes that element for Opus and forgets the addition.
  [[nodiscard]] std::int64_t forgotten_delay(const AVCodecParameters& sound) const;

  Result<void> write_header();
  /// Takes the packet's data; its times are in the stream's time base.
  Result<void> write(AVPacket& packet);
  /// Writes the end of the container and gives the file its name.
  Result<void> finish();

  [[nodiscard]] const std::string& name() const { return file_.name(); }
  [[nodiscard]] bool replaced_leftover() const { return file_.replaced_leftover(); }

  [[nodiscard]] tl::unexpected<Error> error(const std::string& reason) const;

 private:
  explicit AvMuxer(AtomicFile file) : file_(std::move(file)) {}

  static int write_bytes(void* self, std::uint8_t* bytes, int size);
  static std::int64_t seek(void* self, std::int64_t offset, int whence);
  Result<void> check(int code) const;

  AtomicFile file_;
  Result<void> file_state_;  ///< the first failure of file_
  AVFormatContext* context_ = nullptr;
};

}  // namespace fbs
