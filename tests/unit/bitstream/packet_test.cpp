#include "bitstream/packet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <random>
#include <utility>

#include "bitstream/byte_io.h"

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
  /// The first packet from `k` on that a search can find.
  [[nodiscard]] std::size_t next_found(std::size_t k) const {
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
  const std::array<std::pair<PacketType, std::size_t>, 8> packets = {{{PacketType::kSetup, 18},
                                                                      {PacketType::kPattern, 700},
                                                                      {PacketType::kMotion, 0},
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
  for (const std::size_t payload : {0u, 1u, 127u, 128u, 16383u, 16384u, 300000u}) {
    Bytes out;
    EXPECT_EQ(PacketWriter().write(out, PacketType::kEnd, Bytes(payload)), packet_size(payload));
    EXPECT_EQ(out.size(), packet_size(payload));
  }
}

TEST(Packet, WritesFourBytesBesideAShortPayload) {
  Bytes bytes;
  PacketWriter writer;
  EXPECT_EQ(writer.write(bytes, PacketType::kMotion, Bytes(127)), 131u);
  EXPECT_EQ(writer.write(bytes, PacketType::kMotion, Bytes(128)), 133u);
}

// SPEC 3.1
TEST(Packet, CheckGoesOnFromThePacketBefore) {
  const Bytes setup = {1, 2, 0x5A, 0x5A}, motion = {5, 1, 0xA5};
  PacketWriter writer;
  Bytes bytes;
  for (int scene = 0; scene < 2; ++scene) {
    bytes.clear();
    writer.write(bytes, PacketType::kSetup, std::span(setup).subspan(2));
    writer.write(bytes, PacketType::kMotion, std::span(motion).subspan(2));
    ByteReader reader(bytes);
    (void)reader.bytes(setup.size());
    const std::uint16_t check = crc16(setup);
    EXPECT_EQ(reader.u16(), check) << "a setup packet begins anew";
    (void)reader.bytes(motion.size());
    EXPECT_EQ(reader.u16(), crc16(motion, check));
  }
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

TEST(PacketReader, DetectsEveryFlippedBitOfAPacket) {
  Stream stream;
  stream.add(PacketType::kMotion, random_bytes(40, 4));
  const Bytes& good = stream.bytes;
  for (std::size_t bit = 4 * 8; bit < good.size() * 8; ++bit) {
    Bytes bytes = good;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1u << bit % 8);
    PacketReader reader;
    reader.feed(bytes);
    reader.close();
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
  expect_error_at(s.with({0, 2, 3, 4, 5}), 1, "one is missing");
  expect_error_at(s.with({0, 1, 3, 4, 5}), 2, "one without a payload is missing");
  expect_error_at(s.with({0, 3, 4, 5}), 1, "two are missing");
  expect_error_at(s.with({0, 1, 1, 2, 3}), 2, "one is doubled");
  expect_error_at(s.with({0, 2, 1, 3, 4}), 1, "two have changed places");
  expect_error_at(s.with({1, 2, 3, 4, 5}), 0, "a setup packet is missing at the beginning");
  expect_error_at(s.with({0, 1, 2, 3, 5, 6}), 4, "a setup packet is missing");
  expect_error_at(s.with({0, 1, 2, 6, 4, 5}), 3, "one is of another scene");
}

TEST(PacketReader, NoticesThatAnUnknownPacketIsMissing) {
  Stream s;
  s.add(PacketType::kSetup, Bytes{1});
  s.add(static_cast<PacketType>(200), Bytes{2});
  s.add(PacketType::kMotion, Bytes{3});
  expect_error_at(s.with({0, 2}), 1, "the unknown one");
}

// Only the number of pictures can tell what is missing before them: SPEC 6.2.
TEST(PacketReader, SetupAndEndFollowAnything) {
  const Stream s = sample_stream();
  PacketReader reader;
  reader.feed(s.with({0, 1, 4, 5, 7, 4, 4, 7}));
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
    const std::size_t next = s.next_found(damaged + 1);
    ASSERT_TRUE(found.has_value() && found->status == ReadStatus::kPacket) << place;
    EXPECT_EQ(found->packet.offset, s.begins[next]) << place;
    const auto rest = offsets_until_stop(reader, last);
    EXPECT_EQ(next + 1 + rest.size(), s.begins.size());
    EXPECT_TRUE(last.has_value());
  }
}

TEST(PacketReader, ResyncsInAPipeAndMayJoinInTheMiddle) {
  const Stream s = sample_stream();
  const std::size_t joined_at = s.begins[1] + 100;
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
  EXPECT_EQ(offsets, (std::vector(s.begins.begin() + 4, s.begins.end())));
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
TEST(PacketReader, SearchesForSetupAndEndAlone) {
  for (int type = 0; type < 256; ++type) {
    const bool wanted =
        type == static_cast<int>(PacketType::kSetup) || type == static_cast<int>(PacketType::kEnd);
    EXPECT_EQ(found_behind(0, static_cast<PacketType>(type), 9).has_value(), wanted) << type;
  }
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

// Every second byte begins the longest candidate: 16 MB of them take seconds, not hours.
TEST(PacketReader, SearchIsLinearOnHostileBytes) {
  Bytes bytes(std::size_t{1} << 20);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = i % 2 == 0 ? 6 : 127;
  PacketReader reader(bytes);
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_EQ(reader.next()->status, ReadStatus::kEnd);
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
