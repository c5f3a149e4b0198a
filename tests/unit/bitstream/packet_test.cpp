#include "bitstream/packet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <random>
#include <utility>

#include "bitstream/byte_io.h"
#include "bitstream/payload/return_payload.h"

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes random_bytes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  Bytes bytes(count);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

struct Stream {
  Bytes bytes;
  std::vector<std::size_t> begins;
  std::vector<PacketType> types;

  Stream() { write_signature(bytes); }
  void add(PacketType type, const Bytes& payload) {
    begins.push_back(bytes.size());
    types.push_back(type);
    writer.write(bytes, type, payload);
  }
  [[nodiscard]] Bytes packet(std::size_t k) const {
    const auto end = k + 1 < begins.size() ? begins[k + 1] : bytes.size();
    return {bytes.begin() + begins[k], bytes.begin() + end};
  }
  /// Whether a packet belongs to the head of its scene.
  [[nodiscard]] bool in_head(std::size_t k) const {
    while (types[k] != PacketType::kSetup)
      if (types[--k] == PacketType::kPattern) return false;
    return true;
  }
  /// The packet that a search finds behind this one, which is damaged.
  [[nodiscard]] std::size_t next_found(std::size_t damaged) const {
    std::size_t k = damaged + 1;
    if (in_head(damaged))
      while (types[k] != PacketType::kSetup && types[k] != PacketType::kEnd) ++k;
    return k;
  }
  /// The packets with these numbers.
  [[nodiscard]] Bytes with(std::initializer_list<std::size_t> numbers) const {
    Bytes out;
    write_signature(out);
    for (const std::size_t k : numbers) {
      const Bytes one = packet(k);
      out.insert(out.end(), one.begin(), one.end());
    }
    return out;
  }

 private:
  PacketWriter writer;
};

/// A stream of two scenes of different packets.
Stream sample_stream() {
  Stream s;
  const std::array<std::pair<PacketType, std::size_t>, 10> packets = {{{PacketType::kSetup, 18},
                                                                       {PacketType::kGeometry, 90},
                                                                       {PacketType::kPattern, 700},
                                                                       {PacketType::kMotion, 0},
                                                                       {PacketType::kPattern, 200},
                                                                       {PacketType::kMotion, 60},
                                                                       {PacketType::kSetup, 19},
                                                                       {PacketType::kPattern, 300},
                                                                       {PacketType::kMotion, 20},
                                                                       {PacketType::kEnd, 2}}};
  for (const auto& [type, size] : packets) s.add(type, random_bytes(size, static_cast<unsigned>(size)));
  return s;
}

std::vector<std::size_t> offsets_until_stop(PacketReader& reader, Result<ReadResult>& last) {
  std::vector<std::size_t> offsets;
  for (;;) {
    last = reader.next();
    if (!last || last->status != ReadStatus::kPacket) return offsets;
    offsets.push_back(last->packet.offset);
  }
}

TEST(Packet, SizeIsThatOfWhatIsWritten) {
  for (const std::size_t payload : {0u, 1u, 127u, 128u, 255u, 256u, 16383u, 16384u, 300000u}) {
    Bytes out;
    const std::uint32_t check = PacketWriter().write(out, PacketType::kEnd, Bytes(payload));
    EXPECT_EQ(out.size(), packet_size(payload));
    EXPECT_EQ(out.back(), check & 0xFF);
  }
}

TEST(Packet, WritesFourBytesBesideAShortPayload) {
  Bytes bytes;
  PacketWriter writer;
  writer.write(bytes, PacketType::kMotion, Bytes(127));
  EXPECT_EQ(bytes.size(), 131u);
  writer.write(bytes, PacketType::kMotion, Bytes(128));
  EXPECT_EQ(bytes.size(), 131u + 133u);
}

// SPEC 3.1
TEST(CheckChain, RunsThroughTheHeadOfASceneAndThenBeginsWithIt) {
  using enum PacketType;
  PacketWriter writer;
  std::uint16_t head = 0;
  const auto expect_check = [&](PacketType type, std::uint16_t before) {
    Bytes bytes;
    writer.write(bytes, type, Bytes{0x5A});
    const auto check = static_cast<std::uint16_t>(kCrc16.of(std::span(bytes).first(3), before));
    EXPECT_EQ(ByteReader(std::span(bytes).subspan(3)).u16(), check) << static_cast<int>(type);
    return check;
  };
  for (int scene = 0; scene < 2; ++scene) {
    head = expect_check(kSetup, 0xFFFF);
    for (const PacketType type : {kWireFrame, kGeometry, kSurround, kPattern}) {
      for (const PacketType other : {kSoundSetup, kSound, kEnd, static_cast<PacketType>(200)})
        expect_check(other, 0xFFFF);
      head = expect_check(type, head);
    }
    for (const PacketType type : {kMotion, kPattern, kBlend, kSurround, kGeometry, kWireFrame, kMotion})
      expect_check(type, head);
    expect_check(kSound, 0xFFFF);
  }
}

// SPEC 3.1
TEST(CheckChain, BeginsWithTheSceneThatAReturnNames) {
  const auto check_behind = [](const Bytes& payload) {
    Bytes bytes;
    PacketWriter writer;
    writer.write(bytes, PacketType::kSetup, Bytes{1});
    writer.write(bytes, PacketType::kReturn, payload);
    bytes.clear();
    writer.write(bytes, PacketType::kPattern, Bytes{2});  // it ends no head
    bytes.clear();
    writer.write(bytes, PacketType::kMotion, Bytes{0x5A});
    return ByteReader(std::span(bytes).subspan(3)).u16();
  };
  const Bytes motion = {static_cast<std::uint8_t>(PacketType::kMotion), 1, 0x5A};
  EXPECT_EQ(check_behind(encode_return({0x123456, {}, false})), kCrc16.of(motion, 0x3456));
  EXPECT_EQ(check_behind({0xFF}), kCrc16.of(motion, 0)) << "not a varint";
}

TEST(Packet, EndIsTheSameFromAnyWriter) {
  Bytes bytes, alone;
  PacketWriter writer;
  writer.write(bytes, PacketType::kMotion, Bytes(5));
  bytes.clear();
  writer.write(bytes, PacketType::kEnd, Bytes{3});
  PacketWriter().write(alone, PacketType::kEnd, Bytes{3});
  EXPECT_EQ(bytes, alone);
}

TEST(PacketReader, YieldsWhatWasWritten) {
  const Stream s = sample_stream();
  PacketReader reader;
  reader.feed(s.bytes);
  reader.close();
  Result<ReadResult> last;
  EXPECT_EQ(offsets_until_stop(reader, last), s.begins);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->status, ReadStatus::kEnd);
}

TEST(PacketReader, ReadsFromAPipeByteByByte) {
  const Stream s = sample_stream();
  PacketReader reader;
  std::vector<std::size_t> offsets;
  for (const std::uint8_t byte : s.bytes) {
    Result<ReadResult> last;
    reader.feed({&byte, 1});
    const auto more = offsets_until_stop(reader, last);
    offsets.insert(offsets.end(), more.begin(), more.end());
    ASSERT_TRUE(last);
    EXPECT_EQ(last->status, ReadStatus::kNeedMore);
  }
  EXPECT_EQ(offsets, s.begins);
  reader.close();
  EXPECT_EQ(reader.next()->status, ReadStatus::kEnd);
}

TEST(PacketReader, ReportsTruncationAtEveryByte) {
  const Stream s = sample_stream();
  for (std::size_t size = 1; size < s.bytes.size(); ++size) {
    PacketReader reader;
    reader.feed(std::span(s.bytes).first(size));
    reader.close();
    Result<ReadResult> last;
    const auto offsets = offsets_until_stop(reader, last);
    const bool whole = size == 4 || std::find(s.begins.begin(), s.begins.end(), size) != s.begins.end();
    ASSERT_EQ(last.has_value(), whole) << size;
    if (whole) continue;
    EXPECT_EQ(last.error().code, ErrorCode::kTruncated) << size;
    EXPECT_EQ(last.error().byte_offset, size < 4 ? 0 : s.begins[offsets.size()]);
  }
}

TEST(PacketReader, RefusesWhatIsNoStream) {
  PacketReader reader;
  reader.feed(Bytes{0x89, 'P'});
  EXPECT_EQ(reader.next().error().code, ErrorCode::kNotFbs);
  PacketReader empty;
  empty.close();
  EXPECT_EQ(empty.next().error().code, ErrorCode::kNotFbs);
}

// SPEC 3.2
TEST(PacketReader, SetsOneWrongBitOfAPayloadOrCheckRight) {
  for (const std::size_t size : {0U, 40U, 255U, 256U, 3000U}) {
    Stream s;
    s.add(PacketType::kSetup, random_bytes(size, 4));
    s.add(PacketType::kEnd, Bytes{1});
    const std::size_t begin = s.begins[0] + packet_size(size) - size - crc_of(size).bits() / 8;
    for (std::size_t bit = 8 * begin; bit < 8 * s.begins[1]; bit += size < 1000 ? 1 : 97) {
      Bytes bytes = s.bytes;
      bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1U << bit % 8);
      PacketReader reader(bytes);
      const auto read = reader.next();
      ASSERT_TRUE(read.has_value()) << bit;
      EXPECT_TRUE(std::ranges::equal(read->packet.payload, random_bytes(size, 4))) << bit;
      EXPECT_TRUE(read->packet.repaired);
      const auto next = reader.next();
      EXPECT_EQ(next->packet.offset, s.begins[1]) << bit;
      EXPECT_FALSE(next->packet.repaired);
    }
  }
}

TEST(PacketReader, RefusesAPacketWithMoreWrongBits) {
  Stream s;
  s.add(PacketType::kMotion, random_bytes(40, 4));
  for (std::size_t bit = 4 * 8; bit < s.bytes.size() * 8; ++bit) {
    const bool in_front = bit < 6 * 8;  // type and length
    Bytes bytes = s.bytes;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1U << bit % 8);
    if (!in_front) bytes[20] = static_cast<std::uint8_t>(bytes[20] ^ (bit / 8 == 20 ? 0x66U : 1U));
    PacketReader reader(bytes);
    const auto read = reader.next();
    ASSERT_FALSE(read.has_value()) << bit;
    EXPECT_EQ(read.error().byte_offset, 4u);
    EXPECT_EQ(reader.next()->status, ReadStatus::kEnd) << "the error is reported once";
  }
}

TEST(PacketReader, RefusesTooLargeAPayloadBeforeItArrives) {
  PacketReader reader;
  Bytes bytes;
  write_signature(bytes);
  bytes.insert(bytes.end(), {5, 0x81, 0x80, 0x80, 0x08});  // 2^24 + 1
  reader.feed(bytes);
  EXPECT_EQ(reader.next().error().code, ErrorCode::kTooLarge);
}

TEST(PacketReader, YieldsUnknownTypesForTheCallerToSkip) {
  Stream s;
  s.add(static_cast<PacketType>(200), random_bytes(9, 1));
  s.add(PacketType::kMotion, Bytes{1});
  PacketReader reader;
  reader.feed(s.bytes);
  EXPECT_EQ(static_cast<int>(reader.next()->packet.type), 200);
  EXPECT_EQ(reader.next()->packet.type, PacketType::kMotion);
}

/// Expects an error at packet `bad` of those, counted from 0; none if there are no more.
void expect_error_at(const Bytes& stream, std::size_t bad, const char* what) {
  PacketReader reader;
  reader.feed(stream);
  reader.close();
  Result<ReadResult> last;
  EXPECT_EQ(offsets_until_stop(reader, last).size(), bad) << what;
  ASSERT_FALSE(last.has_value()) << what;
  EXPECT_EQ(last.error().code, ErrorCode::kInvalidStream) << what;
}

TEST(PacketReader, NoticesPacketsThatAreNotInTheirPlace) {
  const Stream s = sample_stream();
  expect_error_at(s.with({0, 2, 3, 4, 5}), 1, "one of the head is missing");
  expect_error_at(s.with({0, 1, 3, 4, 5}), 2, "the first pattern is missing");
  expect_error_at(s.with({0, 1, 1, 2, 3}), 2, "one of the head is doubled");
  expect_error_at(s.with({0, 2, 1, 3, 4}), 1, "two of the head have changed places");
  expect_error_at(s.with({0, 1, 2, 2, 3}), 3, "the first pattern is doubled");
  expect_error_at(s.with({1, 2, 3, 4, 5}), 0, "a setup packet is missing at the beginning");
  expect_error_at(s.with({0, 1, 2, 3, 7, 8}), 4, "a setup packet is missing");
  expect_error_at(s.with({0, 1, 2, 8, 6, 7}), 3, "one is of another scene");
  expect_error_at(s.with({6, 7, 3, 8}), 2, "one is of the scene before");
}

// SPEC 3.1
TEST(PacketReader, WhatIsMissingBehindTheHeadDoesNoHarm) {
  const Stream s = sample_stream();
  const auto read_all = [&](std::initializer_list<std::size_t> numbers) {
    PacketReader reader(s.with(numbers));
    Result<ReadResult> last;
    return offsets_until_stop(reader, last).size() == numbers.size() && last.has_value();
  };
  EXPECT_TRUE(read_all({0, 1, 2, 4, 5, 6, 7, 8, 9})) << "without a motion packet";
  EXPECT_TRUE(read_all({0, 1, 2, 3, 5, 6, 7, 8, 9})) << "without a pattern";
  EXPECT_TRUE(read_all({0, 1, 2, 6, 7, 9})) << "without all";
  EXPECT_TRUE(read_all({0, 1, 2, 3, 3, 5, 5})) << "doubled";
  EXPECT_TRUE(read_all({0, 1, 2, 5, 4, 3})) << "in another order";
}

TEST(PacketReader, AHeadWithAGapLosesItsScene) {
  const Stream s = sample_stream();
  PacketReader reader(s.with({0, 2, 3, 4, 5, 6, 7, 8}));
  Result<ReadResult> last;
  EXPECT_EQ(offsets_until_stop(reader, last).size(), 1U);
  EXPECT_FALSE(last);
  const auto rest = offsets_until_stop(reader, last);
  ASSERT_EQ(rest.size(), 3U);
  EXPECT_EQ(rest[0], s.begins[6] - s.packet(1).size()) << "the next setup packet";
  EXPECT_TRUE(last);
}

TEST(PacketReader, UnknownPacketsAndSoundMayBeMissing) {
  Stream s;
  s.add(PacketType::kSetup, Bytes{1});
  s.add(static_cast<PacketType>(200), Bytes{2});
  s.add(PacketType::kSoundSetup, Bytes{3});
  s.add(PacketType::kPattern, Bytes{4});
  PacketReader reader(s.with({0, 3}));
  Result<ReadResult> last;
  EXPECT_EQ(offsets_until_stop(reader, last).size(), 2U);
  EXPECT_TRUE(last);
}

// Only the number of pictures can tell what is missing before them: SPEC 6.2.
TEST(PacketReader, SetupAndEndFollowAnything) {
  const Stream s = sample_stream();
  PacketReader reader;
  reader.feed(s.with({0, 1, 6, 7, 9, 6, 6, 9}));
  reader.close();
  Result<ReadResult> last;
  EXPECT_EQ(offsets_until_stop(reader, last).size(), 8u);
  EXPECT_TRUE(last.has_value());
}

TEST(PacketReader, ResyncsBehindAnyDamagedByte) {
  const Stream s = sample_stream();
  for (std::size_t place = 4; place < s.begins.back(); ++place) {
    Bytes bytes = s.bytes;
    bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ 0x55);
    PacketReader reader;
    reader.feed(bytes);
    reader.close();
    Result<ReadResult> last;
    const std::size_t damaged = offsets_until_stop(reader, last).size();
    ASSERT_FALSE(last.has_value()) << place;
    EXPECT_EQ(last.error().byte_offset, s.begins[damaged]);
    const auto found = reader.next();
    const std::size_t next = s.next_found(damaged);
    ASSERT_TRUE(found.has_value() && found->status == ReadStatus::kPacket) << place;
    EXPECT_EQ(found->packet.offset, s.begins[next]) << place;
    const auto rest = offsets_until_stop(reader, last);
    EXPECT_EQ(next + 1 + rest.size(), s.begins.size());
    EXPECT_TRUE(last.has_value());
  }
}

TEST(PacketReader, ResyncsInAPipeAndMayJoinInTheMiddle) {
  const Stream s = sample_stream();
  const std::size_t joined_at = s.begins[2] + 100;
  PacketReader reader;
  std::vector<std::size_t> offsets;
  for (std::size_t i = joined_at; i < s.bytes.size(); ++i) {
    reader.feed(std::span(s.bytes).subspan(i, 1));
    if (i == joined_at) {
      EXPECT_EQ(reader.next().error().code, ErrorCode::kNotFbs);
    }
    for (;;) {
      const auto read = reader.next();
      ASSERT_TRUE(read.has_value());
      if (read->status != ReadStatus::kPacket) break;
      offsets.push_back(read->packet.offset + joined_at);
    }
  }
  EXPECT_EQ(offsets, (std::vector(s.begins.begin() + 6, s.begins.end())));
}

TEST(PacketReader, SearchEndsWhereNothingIsLeft) {
  Bytes bytes;
  write_signature(bytes);
  bytes.resize(300, 0xFF);
  PacketReader reader(bytes);
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_EQ(reader.next()->status, ReadStatus::kEnd);
  EXPECT_EQ(reader.next()->status, ReadStatus::kEnd);
}

/// Where a search finds a packet after `noise` random bytes; nothing: nowhere.
std::optional<std::size_t> found_behind(std::size_t noise, PacketType type, std::size_t payload) {
  Bytes bytes = random_bytes(noise, 3);
  PacketWriter().write(bytes, type, Bytes(payload, 0x5A));
  PacketReader reader(bytes);
  EXPECT_EQ(reader.next().error().code, ErrorCode::kNotFbs);
  const auto read = reader.next();
  return read->status == ReadStatus::kPacket ? std::optional(read->packet.offset) : std::nullopt;
}

// SPEC 3.2
TEST(PacketReader, SearchesForKnownTypes) {
  for (int type = 0; type < 256; ++type)
    EXPECT_EQ(found_behind(0, static_cast<PacketType>(type), 9).has_value(), type >= 1 && type <= 13) << type;
}

TEST(PacketReader, OfNestedCandidatesTheOneThatEndsFirstIsFound) {
  const auto packet = [](const Bytes& payload) {
    Bytes bytes;
    PacketWriter().write(bytes, PacketType::kEnd, payload);
    return bytes;
  };
  const Bytes inner = packet(Bytes(30, 0xEE));
  Bytes payload(20, 0xEE);
  payload.insert(payload.end(), inner.begin(), inner.end());
  payload.insert(payload.end(), 20, 0xEE);
  const Bytes outer = packet(payload);
  PacketReader reader(outer);
  EXPECT_FALSE(reader.next());
  const auto found = reader.next();
  ASSERT_EQ(found->status, ReadStatus::kPacket);
  EXPECT_EQ(found->packet.offset, 22U);
  EXPECT_EQ(found->packet.payload.size(), 30U);
}

TEST(PacketReader, SearchesBehindNoise) {
  for (const std::size_t noise : {1u, 5u, 300u, 20000u})
    EXPECT_EQ(found_behind(noise, PacketType::kSetup, 60), noise);
}

// SPEC 3.2
TEST(PacketReader, SearchesForShortPayloads) {
  EXPECT_TRUE(found_behind(0, PacketType::kSetup, kMaxSearchedPayload));
  EXPECT_FALSE(found_behind(0, PacketType::kSetup, kMaxSearchedPayload + 1));
}

// Every third byte begins the longest candidate: 16 MB of them take seconds, not hours.
TEST(PacketReader, SearchIsLinearOnHostileBytes) {
  Bytes bytes(std::size_t{1} << 18);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = Bytes{6, 0xFF, 0x0F}[i % 3];
  PacketReader reader(bytes);
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_EQ(reader.next()->status, ReadStatus::kEnd);
}

/// Offsets of packets, and of errors with their codes, in the order in which a reader yields them.
using Yields = std::vector<std::pair<std::uint64_t, int>>;

/// @return whether the stream has ended
bool take_yields(PacketReader& reader, Yields& out) {
  for (;;) {
    const auto read = reader.next();
    if (!read)
      out.emplace_back(read.error().byte_offset, static_cast<int>(read.error().code));
    else if (read->status != ReadStatus::kPacket)
      return read->status == ReadStatus::kEnd;
    else
      out.emplace_back(read->packet.offset, -1);
  }
}

TEST(PacketReader, ReadsTheSameHoweverTheBytesAreCut) {
  std::mt19937 random(78);
  for (int round = 0; round < 500; ++round) {
    Stream s = sample_stream();
    for (unsigned k = 1 + random() % 8; k > 0; --k)
      s.bytes[random() % s.bytes.size()] = static_cast<std::uint8_t>(random());
    const std::size_t removed = random() % s.bytes.size();
    if (round % 2 == 0)
      s.bytes.erase(s.bytes.begin() + removed,
                    s.bytes.begin() + std::min(s.bytes.size(), removed + random() % 200));
    Yields whole, cut;
    PacketReader at_once(s.bytes), reader;
    ASSERT_TRUE(take_yields(at_once, whole));
    const unsigned longest = round % 3 == 0 ? 1 : 90;
    for (std::size_t at = 0; at < s.bytes.size();) {
      const std::size_t size = std::min<std::size_t>(1 + random() % longest, s.bytes.size() - at);
      reader.feed(std::span(s.bytes).subspan(at, size));
      at += size;
      EXPECT_FALSE(take_yields(reader, cut));
    }
    reader.close();
    ASSERT_TRUE(take_yields(reader, cut));
    ASSERT_EQ(cut, whole) << round;
  }
}

TEST(PacketReader, SurvivesRandomBytesInRandomPieces) {
  std::mt19937 random(77);
  for (int round = 0; round < 2000; ++round) {
    Stream s = sample_stream();
    for (unsigned k = random() % 20; k > 0; --k)
      s.bytes[random() % s.bytes.size()] = static_cast<std::uint8_t>(random());
    PacketReader reader;
    std::size_t at = 0;
    int steps = 0;
    while (steps++ < 5000) {
      const auto read = reader.next();
      if (!read) continue;
      if (read->status == ReadStatus::kPacket) {
        ASSERT_LE(read->packet.offset + read->packet.size, s.bytes.size());
      } else if (read->status == ReadStatus::kEnd) {
        break;
      } else if (at < s.bytes.size()) {
        const std::size_t size = std::min<std::size_t>(1 + random() % 90, s.bytes.size() - at);
        reader.feed(std::span(s.bytes).subspan(at, size));
        at += size;
      } else {
        reader.close();
      }
    }
    ASSERT_LT(steps, 5000);
  }
}

}  // namespace
}  // namespace fbs
