#include "cli/decode/sound_output.h"

#include <algorithm>
#include <limits>

#include "bitstream/sound_time.h"

namespace fbs::cli {
namespace {

constexpr int kTranscodedBitrate = 24000;  // bit/s: enough to lose nothing of what Codec 2 has left

/// The setup for a decoder that joins at a later time, with the first frame it needs: its skip covers the
/// frames decoded only to get there.
SoundSetup joined(SoundSetup setup, std::span<const SoundPart> known, std::int64_t begin) {
  if (begin <= 0) return setup;
  const std::int64_t covers = (begin + setup.skip) / setup.duration,
                     ahead = std::max<std::int64_t>(begin + setup.skip - kSoundPreroll, 0) / setup.duration,
                     first = known.empty() ? covers + 1 : known.front().group.first,
                     time = frame_time(setup, std::max(first, std::min(covers, ahead)));
  setup.skip = static_cast<std::int32_t>(std::max<std::int64_t>(begin - time, 0));
  return setup;
}

}  // namespace

Result<SinkSound> SinkSound::create(const SoundSetup& setup, std::span<const SoundPart> known,
                                    std::int64_t begin) {
  if (setup.codec == SoundCodec::kOpus) return SinkSound(joined(setup, known, begin), begin);
  auto decoder = SoundDecoder::create(setup);
  if (!decoder) return fail(decoder.error());
  SoundSettings settings;
  settings.bitrate = kTranscodedBitrate;
  settings.sample_rate = (*decoder)->sample_rate();
  auto encoder = SoundEncoder::create(settings);
  if (!encoder) return fail(encoder.error());
  SinkSound out((*encoder)->setup(), begin);
  out.transcoder_.emplace(Transcoder{DecodedSound(begin), std::move(*encoder)});
  return out;
}

Result<void> SinkSound::add(SoundPart part) {
  if (transcoder_) return transcoder_->decoded.add(std::move(part));
  if (waiting_size_ + memory_of(part.group) > kMaxSoundAhead) return {};  // too far ahead of its pictures
  std::int64_t frame = part.group.first;
  for (std::vector<std::uint8_t>& bytes : part.group.frames) {
    const std::int64_t time = frame_time(part.setup, frame++) - begin_;
    if (time >= -setup_.skip) wait(time, std::move(bytes));
  }
  return {};
}

Result<void> SinkSound::write(std::int64_t end, VideoSink& sink) {
  if (transcoder_ && transcoder_->decoded.sample_rate() != 0) {
    DecodedSound& decoded = transcoder_->decoded;
    for (auto samples = decoded.take(end); !samples.empty(); samples = decoded.take(end)) {
      SoundEncoder::Frames frames;
      if (auto coded = transcoder_->encoder->add(samples, frames); !coded) return coded;
      wait(std::move(frames));
      if (auto written = write_waiting(end, sink); !written) return written;
    }
  }
  return write_waiting(end, sink);
}

Result<void> SinkSound::write_waiting(std::int64_t end, VideoSink& sink) {
  for (; !waiting_.empty() && waiting_.front().first < end - begin_; waiting_.pop_front()) {
    waiting_size_ -= memory_of(waiting_.front().second);
    if (auto written = sink.write_sound(waiting_.front().second, waiting_.front().first); !written)
      return written;
  }
  return {};
}

Result<void> SinkSound::finish(VideoSink& sink) {
  if (!transcoder_) return {};
  SoundEncoder::Frames frames;
  if (auto coded = transcoder_->encoder->finish(frames); !coded) return coded;
  wait(std::move(frames));
  return write_waiting(std::numeric_limits<std::int64_t>::max(), sink);
}

void SinkSound::wait(std::int64_t time, std::vector<std::uint8_t> frame) {
  waiting_size_ += memory_of(frame);
  waiting_.emplace_back(time, std::move(frame));
}

void SinkSound::wait(SoundEncoder::Frames frames) {
  for (auto& frame : frames) wait(frame_time(setup_, transcoder_->frames++), std::move(frame));
}

}  // namespace fbs::cli
