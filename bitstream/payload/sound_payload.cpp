#include "bitstream/payload/sound_payload.h"

#include <algorithm>
#include <array>
#include <utility>

#include "bitstream/byte_io.h"
#include "bitstream/codec2_mode.h"

namespace fbs {
namespace {

/// Durations of Opus frames: 2.5, 5, 10, 20, 40, 60, 80, 100 and 120 ms.
constexpr std::array<std::int32_t, 9> kOpusDurations{120, 240, 480, 960, 1920, 2880, 3840, 4800, 5760};

/// Bytes of a Codec 2 frame; 0 for an unknown mode.
std::size_t codec2_frame_bytes(std::int32_t mode) {
  const Codec2Mode* const known = find_codec2_mode(mode);
  return known != nullptr ? known->frame_bytes : 0;
}

/// How many frames may begin within kMaxSoundGroup.
std::size_t most_frames(const SoundSetup& setup) {
  return static_cast<std::size_t>((kMaxSoundGroup + setup.duration - 1) / setup.duration);
}

bool is_frame(const std::vector<std::uint8_t>& frame, const SoundSetup& setup) {
  return setup.codec == SoundCodec::kCodec2 ? frame.size() == codec2_frame_bytes(setup.mode)
                                            : frame.size() <= kMaxSoundFrame;
}

Result<std::vector<std::uint8_t>> next_frame(ByteReader& reader, const SoundSetup& setup) {
  std::uint64_t size = codec2_frame_bytes(setup.mode);
  if (setup.codec == SoundCodec::kOpus) {
    size = reader.varint();
    if (reader.malformed()) return fail(ErrorCode::kInvalidStream, "a frame of sound has a malformed size");
    if (size > kMaxSoundFrame) return fail(ErrorCode::kTooLarge, "a frame of sound is too large");
  }
  const auto bytes = reader.bytes(static_cast<std::size_t>(size));
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "sound packet ends early");
  return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
}

}  // namespace

bool is_valid(const SoundSetup& s) {
  if (s.skip < 0 || s.skip > kMaxSoundSkip) return false;
  if (s.codec == SoundCodec::kOpus)
    return s.mode == 0 && (s.channels == 1 || s.channels == 2) &&
           std::find(kOpusDurations.begin(), kOpusDurations.end(), s.duration) != kOpusDurations.end();
  const Codec2Mode* const mode = find_codec2_mode(s.mode);
  return s.codec == SoundCodec::kCodec2 && s.channels == 1 && mode != nullptr &&
         mode->duration() == s.duration;
}

Result<std::vector<std::uint8_t>> encode_sound_setup(const SoundSetup& setup) {
  if (!is_valid(setup)) return fail(ErrorCode::kInvalidArgument, "there is no such sound");
  std::vector<std::uint8_t> payload;
  ByteWriter writer(payload);
  writer.u8(static_cast<std::uint8_t>(setup.codec));
  writer.u8(static_cast<std::uint8_t>(setup.channels));
  writer.varint(static_cast<std::uint64_t>(setup.mode));
  writer.varint(static_cast<std::uint64_t>(setup.duration));
  writer.varint(static_cast<std::uint64_t>(setup.skip));
  return payload;
}

Result<std::optional<SoundSetup>> decode_sound_setup(std::span<const std::uint8_t> payload) {
  ByteReader reader(payload);
  const std::uint8_t codec = reader.u8();
  if (codec == 0 && reader.ok()) return fail(ErrorCode::kInvalidStream, "the sound has no codec");
  if (codec > static_cast<std::uint8_t>(SoundCodec::kCodec2)) return std::nullopt;
  const std::uint8_t channels = reader.u8();
  const std::uint64_t mode = reader.varint(), duration = reader.varint(), skip = reader.varint();
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "sound setup ends early");
  if (reader.malformed() || mode > kSoundClock || duration > kSoundClock || skip > kMaxSoundSkip)
    return fail(ErrorCode::kInvalidStream, "the sound's setup is out of range");
  const SoundSetup setup{static_cast<SoundCodec>(codec), channels, static_cast<std::int32_t>(mode),
                         static_cast<std::int32_t>(duration), static_cast<std::int32_t>(skip)};
  if (setup.codec == SoundCodec::kCodec2 && find_codec2_mode(setup.mode) == nullptr) return std::nullopt;
  if (!is_valid(setup)) return fail(ErrorCode::kInvalidStream, "the sound's setup is out of range");
  return setup;
}

Result<std::vector<std::uint8_t>> encode_sound(const SoundGroup& group, const SoundSetup& setup) {
  const bool right = is_valid(setup) && group.first >= 0 && group.first < kMaxSoundFrames &&
                     !group.frames.empty() && group.frames.size() <= most_frames(setup) &&
                     std::all_of(group.frames.begin(), group.frames.end(),
                                 [&](const auto& f) { return is_frame(f, setup); });
  if (!right) return fail(ErrorCode::kInvalidArgument, "no such frames of sound can be sent");
  std::vector<std::uint8_t> payload;
  ByteWriter writer(payload);
  writer.varint(static_cast<std::uint64_t>(group.first));
  for (const std::vector<std::uint8_t>& frame : group.frames) {
    if (setup.codec == SoundCodec::kOpus) writer.varint(frame.size());
    writer.bytes(frame);
  }
  return payload;
}

Result<SoundGroup> decode_sound(std::span<const std::uint8_t> payload, const SoundSetup& setup) {
  ByteReader reader(payload);
  const std::uint64_t first = reader.varint();
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "sound packet ends early");
  if (reader.malformed() || first >= static_cast<std::uint64_t>(kMaxSoundFrames))
    return fail(ErrorCode::kInvalidStream, "the number of a frame of sound is out of range");
  SoundGroup group{static_cast<std::int64_t>(first), {}};
  while (group.frames.empty() || reader.remaining() > 0) {
    if (group.frames.size() == most_frames(setup))
      return fail(ErrorCode::kTooLarge, "a sound packet has more than a second");
    auto frame = next_frame(reader, setup);
    if (!frame) return fail(frame.error());
    group.frames.push_back(std::move(*frame));
  }
  return group;
}

}  // namespace fbs
