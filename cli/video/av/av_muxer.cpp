#include "cli/video/av/av_muxer.h"

#include <string_view>
#include <utility>

namespace fbs {
namespace {

constexpr int kIoBufferSize = 64 * 1024;

}  // namespace

Result<std::unique_ptr<AvMuxer>> AvMuxer::create(const std::string& output, const char* container) {
  av_log_set_level(AV_LOG_QUIET);
  auto file = AtomicFile::create(output);
  if (!file) return fail(file.error());
  std::unique_ptr<AvMuxer> muxer(new AvMuxer(std::move(*file)));
  if (avformat_alloc_output_context2(&muxer->context_, nullptr, container, output.c_str()) < 0) {
    return muxer->error(std::string("this libav has no container ") + container);
  }
  auto* buffer = static_cast<unsigned char*>(av_malloc(kIoBufferSize));
  muxer->context_->pb = avio_alloc_context(buffer, kIoBufferSize, 1, muxer.get(), nullptr, write_bytes,
                                           muxer->file_.seekable() ? seek : nullptr);
  if (muxer->context_->pb == nullptr) {
    av_free(buffer);
    return muxer->error("out of memory");
  }
  return muxer;
}

AvMuxer::~AvMuxer() {
  if (context_ == nullptr) return;
  if (context_->pb != nullptr) {
    av_freep(&context_->pb->buffer);
    avio_context_free(&context_->pb);
  }
  avformat_free_context(context_);
}

AVStream* AvMuxer::add_stream() {
  return avformat_new_stream(context_, nullptr);
}

std::int64_t AvMuxer::forgotten_delay(const AVCodecParameters& sound) const {
  const bool forgets = avformat_version() < AV_VERSION_INT(59, 31, 100);
  const bool written = sound.codec_id == AV_CODEC_ID_OPUS && std::string_view(container().name) == "matroska";
  return forgets && written ? sound.initial_padding : 0;
}

Result<void> AvMuxer::write_header() {
  return check(avformat_write_header(context_, nullptr));
}

Result<void> AvMuxer::write(AVPacket& packet) {
  return check(av_interleaved_write_frame(context_, &packet));
}

Result<void> AvMuxer::finish() {
  if (auto ended = check(av_write_trailer(context_)); !ended) return ended;
  avio_flush(context_->pb);
  if (auto flushed = check(context_->pb->error); !flushed) return flushed;
  return file_.commit();
}

tl::unexpected<Error> AvMuxer::error(const std::string& reason) const {
  return fail(ErrorCode::kIo, "cannot write " + file_.name() + ": " + reason);
}

Result<void> AvMuxer::check(int code) const {
  if (!file_state_) return file_state_;
  if (code < 0) return error(av_reason(code));
  return {};
}

int AvMuxer::write_bytes(void* self, std::uint8_t* bytes, int size) {
  auto& muxer = *static_cast<AvMuxer*>(self);
  if (muxer.file_state_) muxer.file_state_ = muxer.file_.write({bytes, static_cast<std::size_t>(size)});
  return muxer.file_state_ ? size : AVERROR(EIO);
}

std::int64_t AvMuxer::seek(void* self, std::int64_t offset, int whence) {
  auto& muxer = *static_cast<AvMuxer*>(self);
  if (whence != SEEK_SET || offset < 0) return AVERROR(ENOSYS);
  if (muxer.file_state_) muxer.file_state_ = muxer.file_.seek(static_cast<std::uint64_t>(offset));
  return muxer.file_state_ ? offset : AVERROR(EIO);
}

}  // namespace fbs
