#include "cli/encode/sound_track.h"

#include <iterator>
#include <utility>

#include "bitstream/sound_time.h"
#include "cli/video/open/open_video.h"

namespace fbs::cli {
namespace {

constexpr double kPacketBytes = 8;  // of its header and its first frame's number, once a second or more often

}  // namespace

Result<std::unique_ptr<SoundTrack>> SoundTrack::open(const std::string& input, const SoundSettings& settings,
                                                     std::optional<int> track,
                                                     std::optional<std::int64_t> end,
                                                     const StopSignal& stop) {
  auto encoder = SoundEncoder::create(settings);
  if (!encoder) return fail(encoder.error());
  SoundSourceOptions options;
  options.sample_rate = (*encoder)->sample_rate();
  options.channels = settings.channels;
  options.track = track;
  if (end) options.end = *end;
  // Not interrupted by the signal: pictures already read are still encoded, with their sound.
  auto source = open_sound_source(input, options);
  if (!source) return fail(source.error());
  if (!*source) return nullptr;
  return std::unique_ptr<SoundTrack>(new SoundTrack(std::move(*source), std::move(*encoder), stop));
}

Result<double> SoundTrack::code_all() {
  for (;;) {
    if (stop_.raised()) return fail(ErrorCode::kIo, "stopped");
    const auto more = read_more();
    if (!more) return fail(more.error());
    if (!*more) break;
  }
  std::uint64_t bytes = 0;
  for (const auto& frame : frames_) bytes += frame.size() + (setup().codec == SoundCodec::kOpus ? 1 : 0);
  const double seconds = static_cast<double>(frames_.size()) * setup().duration / kSoundClock;
  return seconds > 0 ? 8e-3 * (static_cast<double>(bytes) / seconds + kPacketBytes) : 0;
}

Result<std::vector<SoundGroup>> SoundTrack::before(std::int64_t time) {
  SoundGroup group{first_, {}};
  while (frame_time(setup(), first_) < time) {
    if (!frames_.empty()) {
      group.frames.push_back(std::move(frames_.front()));
      frames_.pop_front();
      ++first_;
      continue;
    }
    const auto more = read_more();
    if (!more) return fail(more.error());
    if (!*more) break;
  }
  if (group.frames.empty()) return std::vector<SoundGroup>();
  return std::vector<SoundGroup>{std::move(group)};
}

Result<bool> SoundTrack::read_more() {
  if (ended_) return false;
  const auto samples = source_->next();
  if (!samples) return fail(samples.error());
  ended_ = !*samples;
  SoundEncoder::Frames frames;
  const auto coded = ended_ ? encoder_->finish(frames) : encoder_->add(**samples, frames);
  if (!coded) return fail(coded.error());
  frames_.insert(frames_.end(), std::make_move_iterator(frames.begin()),
                 std::make_move_iterator(frames.end()));
  return !ended_ || !frames.empty();
}

}  // namespace fbs::cli
