#include "cli/matroska/stream_mapping.h"

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <utility>

#include "bitstream/packet.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/sound_payload.h"
#include "bitstream/sound_time.h"
#include "cli/matroska/block_division.h"
#include "cli/stream/sound_interleaver.h"
#include "decoder/sound/opus_packet.h"

namespace fbs::cli {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Largest deviation of blocks from their place: Matroska's usual times are whole milliseconds. 1/kSoundClock
/// s.
constexpr std::int64_t kTolerance = kSoundClock * 12 / 10000;

/// @param ticks  1/90000 s, up to kMaxMatroskaTime
std::int64_t ns_of_ticks(std::uint64_t ticks) {
  return static_cast<std::int64_t>((ticks * 100'000 + 4) / 9);
}

std::int64_t ns_of_sound(std::int64_t time) {
  return (time * 125'000 + 3) / 6;
}

std::int64_t sound_of_ns(std::int64_t ns) {
  return (ns * 6 + (ns < 0 ? -62'500 : 62'500)) / 125'000;
}

/// One packet in this many may have another length: damaged, and lost.
constexpr std::size_t kMostOthers = 10;

struct Frame {
  std::int64_t number;
  Bytes bytes;
};

/// A stream with its sound taken apart.
struct Parted {
  Bytes pictures;  ///< also a stream
  std::optional<SoundSetup> setup;
  std::vector<Frame> frames;
};

Result<void> take_sound(const Packet& packet, Parted& out) {
  if (packet.type == PacketType::kSoundSetup) {
    const auto setup = decode_sound_setup(packet.payload);
    if (!setup) return fail(setup.error());
    if (!*setup || (*setup)->codec != SoundCodec::kOpus || (out.setup && out.setup != *setup))
      return fail(ErrorCode::kUnsupported, "sound that has no track in Matroska");
    out.setup = *setup;
    return {};
  }
  if (!out.setup) return fail(ErrorCode::kInvalidStream, "sound before its setup");
  auto group = decode_sound(packet.payload, *out.setup);
  if (!group) return fail(group.error());
  for (Bytes& frame : group->frames) out.frames.push_back({group->first++, std::move(frame)});
  return {};
}

/// @return an error for a damaged stream, and for sound of another kind than Opus
Result<Parted> part(std::span<const std::uint8_t> stream) {
  PacketReader reader(stream);
  Parted out;
  write_signature(out.pictures);
  PacketWriter writer;
  for (;;) {
    const auto read = reader.next();
    if (!read) return fail(read.error());
    if (read->status != ReadStatus::kPacket) return out;
    if (!is_sound(read->packet.type))
      writer.write(out.pictures, read->packet.type, read->packet.payload);
    else if (auto taken = take_sound(read->packet, out); !taken)
      return fail(taken.error());
  }
}

int display_width(const VideoFormat& format) {
  const auto [num, den] = format.pixel_aspect;
  if (num == 0 || den == 0) return format.width;
  const double width = static_cast<double>(format.width) * num / den;
  return static_cast<int>(std::clamp(width + 0.5, 1.0, 1e6));
}

Result<MatroskaVideo> video_of(std::span<const std::uint8_t> stream) {
  const auto divided = divide_stream(stream);
  if (!divided) return fail(divided.error());
  const auto& [blocks, setup, begin, end, constant_rate] = *divided;
  const std::uint64_t first = blocks.empty() ? 0 : blocks.front().time;
  MatroskaVideo out;
  out.width = setup.format.width;
  out.height = setup.format.height;
  out.display_width = display_width(setup.format);
  if (constant_rate) out.picture_duration = ns_of_ticks(nominal_duration(setup.format.frame_rate));
  write_signature(out.setup);
  const auto bytes = [&](std::size_t from, std::size_t to) { return stream.subspan(from, to - from); };
  const auto packet = bytes(begin, end);
  out.setup.insert(out.setup.end(), packet.begin(), packet.end());
  constexpr std::uint64_t kMost = kMaxMatroskaTime / 100'000 * 9;
  for (const StreamBlock& b : blocks) {
    if (b.time < first || b.time - first > kMost || b.duration > kMost)
      return fail(ErrorCode::kTooLarge, "is too long for Matroska");
    const auto part = bytes(b.begin, b.end);
    const std::int64_t time = ns_of_ticks(b.time - first);
    out.blocks.push_back(
        {time, ns_of_ticks(b.time - first + b.duration) - time, b.key, {part.begin(), part.end()}});
  }
  return out;
}

Bytes bytes_of(const MatroskaVideo& video) {
  Bytes out;
  write_signature(out);
  for (const MatroskaBlock& b : video.blocks) out.insert(out.end(), b.bytes.begin(), b.bytes.end());
  return out;
}

/// Time in the stream at time 0 of the file, ns. Files count from their own first picture.
Result<std::int64_t> time_of_file(const MatroskaVideo& video, std::span<const std::uint8_t> stream) {
  PacketReader reader;
  reader.feed(stream);
  const auto read = reader.next();
  if (!read) return fail(read.error());
  if (read->status != ReadStatus::kPacket || read->packet.type != PacketType::kSetup || video.blocks.empty())
    return fail(ErrorCode::kInvalidStream, "the video track does not begin with a setup packet");
  const auto setup = decode_setup(read->packet.payload);
  if (!setup) return fail(setup.error());
  if (setup->before.time > static_cast<std::uint64_t>(kMaxMatroskaTime / 100'000 * 9))
    return fail(ErrorCode::kTooLarge, "is too late for sound of Matroska");
  return ns_of_ticks(setup->before.time) - video.blocks.front().time;
}

/// Puts the frames of a parted stream on the file's clock.
/// @return an error for frames before the file begins, or beyond its end
Result<MatroskaSound> sound_of(const Parted& parted, const MatroskaVideo& video) {
  const auto shift = time_of_file(video, parted.pictures);
  if (!shift) return fail(shift.error());
  const SoundSetup& setup = *parted.setup;
  MatroskaSound out{setup.channels, setup.skip, setup.duration, {}};
  for (const Frame& frame : parted.frames) {
    if (frame.bytes.empty()) continue;
    if (frame.number > kMaxMatroskaTime / 1'000'000'000 * kSoundClock / setup.duration)
      return fail(ErrorCode::kTooLarge, "sound beyond what Matroska can say");
    const std::int64_t time = ns_of_sound(frame.number * setup.duration) - *shift;
    if (time < 0) return fail(ErrorCode::kUnsupported, "sound before the first picture");
    out.blocks.push_back({time, ns_of_sound(setup.duration), true, frame.bytes});
  }
  return out;
}

/// The frames of a track by number; a short gap has empty ones.
struct NumberedSound {
  SoundSetup setup;
  std::vector<Frame> frames;
};

Result<NumberedSound> numbered(const MatroskaSound& sound, std::int64_t shift) {
  NumberedSound out{{SoundCodec::kOpus, sound.channels, 0, sound.duration, sound.skip}, {}};
  if (!is_valid(out.setup))
    return fail(ErrorCode::kUnsupported, "its sound is not of a kind that streams have");
  const std::int64_t duration = sound.duration;
  const auto fits = [&](const MatroskaBlock& b) { return opus_duration(b.bytes) == duration; };
  const auto others = static_cast<std::size_t>(std::ranges::count_if(sound.blocks, std::not_fn(fits)));
  if (others > sound.blocks.size() / kMostOthers)
    return fail(ErrorCode::kUnsupported, "its Opus packets differ in length, as those of a stream cannot");
  std::int64_t off_grid = 0;
  for (const MatroskaBlock& block : sound.blocks) {
    const std::int64_t time = sound_of_ns(block.time + shift);
    if (&block == sound.blocks.data()) {
      const std::int64_t rest = ((time % duration) + duration) % duration;
      if (rest > kTolerance && rest < duration - kTolerance) off_grid = duration - rest;
    }
    const std::int64_t number = (time + off_grid + duration / 2) / duration;
    if (time < -kTolerance || number >= kMaxSoundFrames) continue;
    const std::int64_t next = out.frames.empty() ? number : out.frames.back().number + 1;
    if (number < next || block.bytes.size() > kMaxSoundFrame || !fits(block)) continue;  // lost
    if ((number - next) * duration < kMaxSoundGroup)
      for (std::int64_t missing = next; missing < number; ++missing) out.frames.push_back({missing, {}});
    out.frames.push_back({number, block.bytes});
  }
  out.setup.skip += static_cast<std::int32_t>(off_grid);
  if (!is_valid(out.setup))
    return fail(ErrorCode::kUnsupported, "its sound begins too far from its pictures");
  return out;
}

/// Feeds numbered sound to an interleaver.
class NumberedFeed {
 public:
  explicit NumberedFeed(NumberedSound sound) : sound_(std::move(sound)) {}

  std::vector<SoundGroup> before(std::int64_t time) {
    std::vector<SoundGroup> groups;
    for (; next_ < sound_.frames.size(); ++next_) {
      auto& [number, bytes] = sound_.frames[next_];
      if (frame_time(sound_.setup, number) >= time) break;
      if (groups.empty() ||
          groups.back().first + static_cast<std::int64_t>(groups.back().frames.size()) != number)
        groups.push_back({number, {}});
      groups.back().frames.push_back(std::move(bytes));
    }
    return groups;
  }

 private:
  NumberedSound sound_;
  std::size_t next_ = 0;
};

/// @return nothing if the sound would not come back unchanged
std::optional<MatroskaContent> with_sound_apart(std::span<const std::uint8_t> stream) {
  const auto parted = part(stream);
  if (!parted || !parted->setup) return std::nullopt;
  auto video = video_of(parted->pictures);
  if (!video) return std::nullopt;
  auto sound = sound_of(*parted, *video);
  if (!sound) return std::nullopt;
  MatroskaContent content{std::move(*video), std::move(*sound)};
  const auto back = of_matroska(content);
  if (!back || !std::ranges::equal(*back, stream)) return std::nullopt;
  return content;
}

}  // namespace

bool has_sound_inside(const MatroskaVideo& video) {
  const Bytes stream = bytes_of(video);
  PacketReader reader(stream);
  for (;;) {
    const auto read = reader.next();
    if (!read) continue;
    if (read->status != ReadStatus::kPacket) return false;
    if (is_sound(read->packet.type)) return true;
  }
}

Result<MatroskaContent> to_matroska(std::span<const std::uint8_t> stream) {
  if (auto parted = with_sound_apart(stream)) return std::move(*parted);
  auto video = video_of(stream);
  if (!video) return fail(video.error());
  return MatroskaContent{std::move(*video), std::nullopt};
}

Result<Bytes> of_matroska(const MatroskaContent& content) {
  Bytes stream = bytes_of(content.video);
  if (!content.sound || has_sound_inside(content.video)) return stream;
  const auto shift = time_of_file(content.video, stream);
  if (!shift) return fail(shift.error());
  auto sound = numbered(*content.sound, *shift);
  if (!sound) return fail(sound.error());
  const SoundSetup setup = sound->setup;
  NumberedFeed feed(std::move(*sound));
  SoundInterleaver interleaver(
      setup, [&](std::int64_t before) -> Result<std::vector<SoundGroup>> { return feed.before(before); });
  return interleaver.add(stream);
}

}  // namespace fbs::cli
