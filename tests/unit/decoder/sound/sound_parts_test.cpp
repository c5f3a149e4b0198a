#include "decoder/sound/sound_parts.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "bitstream/payload/sound_payload.h"
#include "cli/stream/sound_interleaver.h"
#include "decoder/stream/stream_decoder.h"
#include "tests/unit/decoder/stream/stream_writer.h"

namespace fbs::cli {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr SoundSetup kVoice{SoundCodec::kOpus, 1, 0, 960, 312};

/// A vector, by default of several scenes, with frames of 20 ms that have their number in them.
Bytes stream_with_sound(const std::string& vector = "late.fbs") {
  std::ifstream file(FBS_VECTORS "/" + vector, std::ios::binary);
  const Bytes stream(std::istreambuf_iterator<char>(file), {});
  SoundGroup group{0, {}};
  const auto feed = [&](std::int64_t before) -> Result<std::vector<SoundGroup>> {
    group = {group.first + static_cast<std::int64_t>(group.frames.size()), {}};
    for (std::int64_t k = group.first; k * kVoice.duration - kVoice.skip < before; ++k)
      group.frames.push_back({static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(k >> 8)});
    return group.frames.empty() ? std::vector<SoundGroup>() : std::vector<SoundGroup>{group};
  };
  return SoundInterleaver(kVoice, feed).add(stream).value();
}

std::vector<SoundGroup> decoded(const Bytes& stream) {
  StreamDecoder decoder;
  decoder.keep_sound();
  decoder.feed(stream);
  decoder.close();
  std::vector<SoundGroup> out;
  for (;;) {
    const auto status = decoder.next();
    for (SoundPart& part : decoder.take_sound()) out.push_back(std::move(part.group));
    if (status && *status == DecodeStatus::kEnd) return out;
  }
}

std::vector<SoundGroup> read(const Bytes& stream, bool follows_pictures = false) {
  SoundParts parts;
  if (follows_pictures) parts.follow_pictures();
  parts.add(stream);
  std::vector<SoundGroup> out;
  for (const SoundPart& part : parts.all()) out.push_back(part.group);
  return out;
}

TEST(SoundPartsOfStream, AreWhatTheDecoderOfPicturesGives) {
  const Bytes stream = stream_with_sound();
  EXPECT_GT(read(stream).size(), 1U);
  EXPECT_EQ(read(stream), decoded(stream));
}

/// Type of the packet with this byte.
PacketType type_at(const Bytes& stream, std::size_t at) {
  PacketReader reader(stream);
  for (;;) {
    const auto read = reader.next();
    if (read->status != ReadStatus::kPacket || at < read->packet.offset + read->packet.size)
      return read->packet.type;
  }
}

TEST(SoundPartsOfStream, AreTheSameAfterDamageAnywhere) {
  const Bytes stream = stream_with_sound();
  std::size_t lost = 0;
  for (std::size_t at = 5; at < stream.size(); at += stream.size() / 41) {
    Bytes damaged = stream;
    damaged[at] ^= 0x5A;
    const auto parts = read(damaged);
    EXPECT_EQ(parts, decoded(damaged)) << at;
    const PacketType type = type_at(stream, at);
    if (is_sound(type)) {
      EXPECT_LT(parts.size(), read(stream).size()) << at;
    } else if (type != PacketType::kSetup) {
      EXPECT_EQ(parts, read(stream)) << at << ": what is damaged is no sound";
    }
    lost += is_sound(type) ? 1 : 0;
  }
  EXPECT_GT(lost, 5U);
}

// SPEC 6.2: behind the head of a scene a loss costs no sound.
TEST(SoundPartsOfStream, AreTheSameBehindLostMotion) {
  Writer w;
  w.setup().packet(PacketType::kSoundSetup, encode_sound_setup(kVoice)).pattern().motion(0, 5, true);
  w.motion(5, 10).packet(PacketType::kSound, encode_sound({0, {{1}}}, kVoice)).motion(10, 15, true);
  w.bytes[w.begins[4] + 3] ^= 1;
  EXPECT_EQ(decoded(w.bytes).size(), 1U);
  EXPECT_EQ(read(w.bytes), decoded(w.bytes));
}

// SPEC 6.5
TEST(SoundPartsOfStream, AreThoseOfASceneThatIsJoinedByThePartsOfItsHead) {
  const Bytes stream = stream_with_sound("live_parts.fbs");
  PacketReader reader(stream);
  std::size_t begin = 0;
  for (int units = 0; units < 3;) {
    const auto read = reader.next();
    ASSERT_EQ(read->status, ReadStatus::kPacket);
    begin = read->packet.offset;
    if (read->packet.type == PacketType::kUnit) ++units;
  }
  const Bytes joined(stream.begin() + static_cast<std::ptrdiff_t>(begin), stream.end());
  EXPECT_FALSE(decoded(joined).empty());
  EXPECT_EQ(read(joined, true), decoded(joined));
  EXPECT_TRUE(read(joined).empty());
}

TEST(SoundPartsOfStream, PicturesAreReleasedWithTheirSound) {
  const Bytes stream = stream_with_sound();
  SoundParts parts, plain;
  parts.follow_pictures();
  std::uint64_t released = 0;
  for (const std::uint8_t byte : stream) {
    parts.add({&byte, 1});
    if (parts.released() == released) continue;
    released = parts.released();
    ASSERT_FALSE(parts.all().empty());
    EXPECT_GE(end_of(parts.all().back()) * 90000, static_cast<std::int64_t>(released) * kSoundClock);
  }
  StreamDecoder decoder;
  decoder.feed(stream);
  decoder.close();
  while (decoder.next().value() == DecodeStatus::kPicture) continue;
  EXPECT_EQ(released, decoder.position().time + decoder.duration());
  plain.add(stream);
  EXPECT_EQ(plain.released(), 0U);
}

}  // namespace
}  // namespace fbs::cli
