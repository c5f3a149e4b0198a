#include "cli/video/av/av_track.h"

namespace fbs {

int AvTrack::open(const StopSignal* stop) {
  int code = 0;
  container_ = open_av_input(name_, stop, code);
  return code;
}

Result<void> AvTrack::choose(int index, const AVCodec& codec, int threads, const std::string& kind) {
  stream_ = container_->streams[index];
  discard_others(*container_, index);
  decoder_.reset(avcodec_alloc_context3(&codec));
  if (!decoder_) return error(ErrorCode::kInternal, "out of memory");
  int code = avcodec_parameters_to_context(decoder_.get(), stream_->codecpar);
  decoder_->pkt_timebase = stream_->time_base;  // lets a sound decoder leave out the encoder's delay
  decoder_->thread_count = threads;
  if (code >= 0) code = avcodec_open2(decoder_.get(), &codec, nullptr);
  if (code < 0) return error(ErrorCode::kUnsupported, "cannot decode its " + kind + ": " + av_reason(code));
  return {};
}

Result<bool> AvTrack::decode() {
  for (;;) {
    const int code = avcodec_receive_frame(decoder_.get(), frame_.get());
    if (code == AVERROR_EOF && failure_) return fail(*failure_);
    if (code == AVERROR_EOF) return false;
    if (code >= 0) return true;
    if (code != AVERROR(EAGAIN)) {
      ++damaged_packets_;
      continue;
    }
    if (auto fed = feed(); !fed) return fail(fed.error());
  }
}

Result<void> AvTrack::feed() {
  if (drained_) return error(ErrorCode::kInternal, "decoder does not end");
  const std::int64_t complaints = demuxer_complaints();
  int code = 0;
  do {
    av_packet_unref(packet_.get());
    code = av_read_frame(container_.get(), packet_.get());
  } while (code >= 0 && packet_->stream_index != stream_->index);
  if (code < 0) {
    note_failure(code, demuxer_complaints() > complaints || last_packet_cut_);
    drained_ = true;
    avcodec_send_packet(decoder_.get(), nullptr);
    return {};
  }
  last_packet_cut_ = (packet_->flags & AV_PKT_FLAG_CORRUPT) != 0;
  if (avcodec_send_packet(decoder_.get(), packet_.get()) < 0) ++damaged_packets_;
  return {};
}

void AvTrack::note_failure(int code, bool cut) {
  if (code == AVERROR_EOF && !cut) return;
  const bool damaged = code == AVERROR_EOF || code == AVERROR_INVALIDDATA;
  failure_ = Error{damaged ? ErrorCode::kTruncated : ErrorCode::kIo,
                   name_ + ": " + (damaged ? "cut off or damaged" : av_reason(code))};
}

std::optional<std::int64_t> AvTrack::frame_time(AVRational unit) const {
  if (frame_->best_effort_timestamp == AV_NOPTS_VALUE) return std::nullopt;
  return av_rescale_q(frame_->best_effort_timestamp, stream_->time_base, unit);
}

}  // namespace fbs
