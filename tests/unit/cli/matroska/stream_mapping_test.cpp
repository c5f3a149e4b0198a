#include "cli/matroska/stream_mapping.h"

#include <algorithm>

#include "bitstream/packet.h"
#include "cli/matroska/block_division.h"
#include "decoder/stream/stream_decoder.h"
#include "tests/unit/cli/matroska/voiced_vector.h"
#include "tests/unit/decoder/stream/stream_writer.h"

namespace fbs::cli {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr const char* kValid[] = {
    "talk.fbs",   "patterns.fbs", "two_heads.fbs", "durations.fbs", "odd.fbs",   "one.fbs",     "late.fbs",
    "joined.fbs", "nobody.fbs",   "limits.fbs",    "blends.fbs",    "turns.fbs", "replaced.fbs"};

MatroskaContent content_of(const Bytes& stream) {
  auto content = to_matroska(stream);
  EXPECT_TRUE(content) << content.error().text;
  return content.value_or(MatroskaContent{});
}

Bytes back(const MatroskaContent& content) {
  const auto stream = of_matroska(content);
  EXPECT_TRUE(stream) << stream.error().text;
  return stream.value_or(Bytes{});
}

/// Beginning of each picture and the end of the last, 1/90000 s.
std::vector<std::uint64_t> picture_times(const Bytes& stream) {
  StreamDecoder decoder;
  decoder.feed(stream);
  decoder.close();
  std::vector<std::uint64_t> times{0};
  for (auto status = decoder.next(); status && *status == DecodeStatus::kPicture; status = decoder.next()) {
    times.back() = decoder.position().time;
    times.push_back(decoder.position().time + decoder.duration());
  }
  return times;
}

TEST(StreamMapping, VectorsComeBackTheSame) {
  for (const char* name : kValid) {
    const Bytes stream = vector_file(name);
    const MatroskaContent content = content_of(stream);
    EXPECT_FALSE(content.sound);
    EXPECT_EQ(back(content), stream) << name;
  }
}

TEST(StreamMapping, BlocksFollowOneAnotherFromPictureToPicture) {
  for (const char* name : kValid) {
    const Bytes stream = vector_file(name);
    const auto divided = divide_stream(stream);
    ASSERT_TRUE(divided) << name;
    const auto times = picture_times(stream);
    std::size_t end = kSignature.size();
    std::uint64_t until = times.front();
    for (const StreamBlock& b : divided->blocks) {
      EXPECT_EQ(b.begin, end) << name;
      EXPECT_EQ(b.time, until) << name;
      EXPECT_TRUE(std::ranges::binary_search(times, b.time)) << name;
      EXPECT_EQ(b.key, stream[b.begin] == 1) << name;
      end = b.end;
      until = b.time + b.duration;
    }
    EXPECT_EQ(end, stream.size()) << name;
    EXPECT_EQ(until, times.back()) << name;
    EXPECT_TRUE(divided->blocks.front().key);
  }
}

TEST(StreamMapping, EachSceneBeginsAKeyBlock) {
  const auto blocks = divide_stream(vector_file("two_heads.fbs"))->blocks;
  EXPECT_GE(std::ranges::count_if(blocks, [](const StreamBlock& b) { return b.key; }), 2);
}

// SPEC 6.6
TEST(StreamMapping, ReturnBeginsABlockThatIsNoKey) {
  Writer w;
  fbs::Setup other = setup_at({5, 15000});
  other.keeps = SceneKeeping::kAndPresent;
  w.scene({}, 5).setup(other).pattern().motion(0, 5, true).packet(static_cast<PacketType>(99), Bytes{1});
  w.go_back(0, {10, 30000}).motion(5, 10).scene({15, 45000}, 5).end(20);
  const auto blocks = divide_stream(w.bytes)->blocks;
  ASSERT_EQ(blocks.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(blocks[k].time, 15000 * k) << k;
    EXPECT_EQ(blocks[k].duration, 15000U) << k;
    EXPECT_EQ(blocks[k].key, k == 0 || k == 3) << k;
  }
  EXPECT_EQ(blocks[2].begin, w.begins[9]);
  EXPECT_EQ(back(content_of(w.bytes)), w.bytes);
}

TEST(StreamMapping, WhatFollowsTheLastPicturesStaysInTheirBlock) {
  const Bytes plain = vector_file("two_heads.fbs");
  PacketReader reader;
  reader.feed(plain);
  PacketWriter writer;
  Bytes stream;
  write_signature(stream);
  for (auto read = reader.next(); read->status == ReadStatus::kPacket; read = reader.next()) {
    if (read->packet.type == PacketType::kSetup && stream.size() > kSignature.size())
      writer.write(stream, static_cast<PacketType>(99), Bytes{1, 2, 3});
    writer.write(stream, read->packet.type, read->packet.payload);
  }
  const auto blocks = divide_stream(stream)->blocks, before = divide_stream(plain)->blocks;
  ASSERT_EQ(blocks.size(), before.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    EXPECT_EQ(blocks[i].key, before[i].key) << i;
    EXPECT_EQ(blocks[i].time, before[i].time) << i;
  }
}

TEST(StreamMapping, SaysTheRateOnlyWhereItIsConstant) {
  EXPECT_EQ(content_of(vector_file("talk.fbs")).video.picture_duration, 33'333'333);
  EXPECT_EQ(content_of(vector_file("durations.fbs")).video.picture_duration, 0);
}

TEST(StreamMapping, OpusIsATrack) {
  for (const char* name : kValid) {
    const Bytes plain = vector_file(name);
    const std::uint64_t begin = divide_stream(plain)->setup.before.time;
    if (begin > 1'000'000'000) continue;  // frames have no such numbers
    const auto first = static_cast<std::int64_t>(begin * kSoundClock / kTicksPerSecond / 960 + 1);
    const Bytes stream = voiced(plain, begin == 0 ? 0 : first);
    const MatroskaContent content = content_of(stream);
    ASSERT_TRUE(content.sound) << name;
    EXPECT_FALSE(has_sound_inside(content.video)) << name;
    EXPECT_EQ(content.video.setup, content_of(plain).video.setup) << name;
    EXPECT_EQ(back(content), stream) << name;
    if (begin > 0) continue;
    const auto& blocks = content.sound->blocks;
    for (std::size_t n = 0; n < blocks.size(); ++n) EXPECT_EQ(blocks[n].time, 20 * kMillisecond * n);
    ASSERT_FALSE(blocks.empty());
    EXPECT_EQ(content.sound->skip, kVoice.skip);
  }
}

TEST(StreamMapping, LostFramesComeBackEmpty) {
  const Bytes plain = vector_file("talk.fbs");
  for (const int lost : {1, 3}) {
    const Bytes stream = voiced(plain, kVoice, 0, [lost](std::int64_t n) { return n >= 5 && n < 5 + lost; });
    const MatroskaContent content = content_of(stream);
    ASSERT_TRUE(content.sound);
    EXPECT_TRUE(std::ranges::none_of(content.sound->blocks, [](const auto& b) { return b.bytes.empty(); }));
    EXPECT_EQ(back(content), stream);
  }
}

TEST(StreamMapping, SoundThatWouldChangeStaysInside) {
  const Bytes plain = vector_file("talk.fbs");
  const SoundSetup codec2{SoundCodec::kCodec2, 1, 1200, 1920, 0};
  SoundInterleaver interleaver(codec2, [](std::int64_t) -> Result<std::vector<SoundGroup>> {
    return std::vector<SoundGroup>{{0, {Bytes(6)}}};
  });
  const Bytes ends_empty = voiced(plain, kVoice, 0, [](std::int64_t n) { return n >= 2; });
  const Bytes whole = voiced(plain);
  const Bytes cut(whole.begin(), whole.end() - 3);
  for (const Bytes& stream : {*interleaver.add(plain), ends_empty, cut}) {
    const MatroskaContent content = content_of(stream);
    EXPECT_FALSE(content.sound);
    EXPECT_TRUE(has_sound_inside(content.video));
    EXPECT_EQ(back(content), stream);
  }
}

TEST(StreamMapping, TimesOfAFileMayBeShifted) {
  const Bytes stream = voiced(vector_file("talk.fbs"));
  MatroskaContent content = content_of(stream);
  for (const std::int64_t shift : {400, 5003}) {
    MatroskaContent moved = content;
    for (MatroskaBlock& b : moved.video.blocks) b.time += shift * kMillisecond;
    for (MatroskaBlock& b : moved.sound->blocks) b.time += shift * kMillisecond + kMillisecond / 3;
    EXPECT_EQ(back(moved), stream) << shift;
  }
}

TEST(StreamMapping, SoundOffTheGridOfItsFramesMovesIt) {
  MatroskaContent content = content_of(voiced(vector_file("talk.fbs")));
  for (MatroskaBlock& b : content.sound->blocks) b.time += 7 * kMillisecond;
  StreamDecoder decoder;
  decoder.keep_sound();
  decoder.feed(back(content));
  decoder.close();
  ASSERT_EQ(*decoder.next(), DecodeStatus::kPicture);
  const auto sound = decoder.take_sound();
  ASSERT_FALSE(sound.empty());
  const SoundSetup& setup = sound.front().setup;
  EXPECT_EQ(sound.front().group.first * setup.duration - setup.skip, 7 * kSoundClock / 1000 - kVoice.skip);
}

TEST(StreamMapping, PacketsOfAnotherLengthAreLost) {
  const auto content = content_of(voiced(vector_file("talk.fbs")));
  ASSERT_GT(content.sound->blocks.size(), 20U);
  constexpr std::uint8_t kTenMilliseconds = 0;
  MatroskaContent one = content, all = content;
  one.sound->blocks[3].bytes[0] = kTenMilliseconds;
  EXPECT_EQ(back(one), voiced(vector_file("talk.fbs"), kVoice, 0, [](std::int64_t n) { return n == 3; }));
  for (std::size_t n = 1; n < all.sound->blocks.size(); n += 2)
    all.sound->blocks[n].bytes[0] = kTenMilliseconds;
  const auto refused = of_matroska(all);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
}

TEST(StreamMapping, SoundInsideIsNotDoubled) {
  const Bytes stream = voiced(vector_file("talk.fbs"));
  MatroskaContent content = content_of(stream);
  content.video.blocks = {{0, 0, true, Bytes(stream.begin() + kSignature.size(), stream.end())}};
  EXPECT_EQ(back(content), stream);
}

TEST(StreamMapping, DamageStaysWhereItIs) {
  const Bytes stream = voiced(vector_file("patterns.fbs"));
  for (std::size_t at = 60; at < stream.size(); at += 37) {
    Bytes damaged = stream;
    damaged[at] ^= 4;
    EXPECT_EQ(back(content_of(damaged)), damaged) << at;
  }
}

TEST(StreamMapping, RefusesWhatIsNoStream) {
  const auto code = [](const Bytes& bytes) { return to_matroska(bytes).error().code; };
  EXPECT_EQ(code({}), ErrorCode::kNotFbs);
  EXPECT_EQ(code({1, 2, 3, 4, 5}), ErrorCode::kNotFbs);
  EXPECT_EQ(code(Bytes(kSignature.begin(), kSignature.end())), ErrorCode::kTruncated);
  EXPECT_EQ(code(vector_file("newer.fbs")), ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace fbs::cli
