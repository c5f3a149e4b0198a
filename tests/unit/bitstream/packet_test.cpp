#include "bitstream/packet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

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
};

Stream sample_stream() {
  Stream s;
  write_signature(s.bytes);
  const std::array<std::pair<PacketType, std::size_t>, 5> packets = {{{PacketType::kSetup, 18},
                                                                      {PacketType::kPattern, 700},
                                                                      {PacketType::kMotion, 0},
                                                                      {PacketType::kMotion, 60},
                                                                      {PacketType::kEnd, 2}}};
  for (const auto& [type, size] : packets) {
    s.begins.push_back(s.bytes.size());
    write_packet(s.bytes, type, random_bytes(size, static_cast<unsigned>(size)));
  }
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
    EXPECT_EQ(write_packet(out, PacketType::kEnd, Bytes(payload)), packet_size(payload));
    EXPECT_EQ(out.size(), packet_size(payload));
  }
}

TEST(Packet, WritesFourBytesBesideAShortPayload) {
  Bytes bytes;
  EXPECT_EQ(write_packet(bytes, PacketType::kMotion, Bytes(127)), 131u);
  EXPECT_EQ(write_packet(bytes, PacketType::kMotion, Bytes(128)), 133u);
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
  Bytes good;
  write_signature(good);
  write_packet(good, PacketType::kMotion, random_bytes(40, 4));
  for (std::size_t bit = 4 * 8; bit < good.size() * 8; ++bit) {
    Bytes bytes = good;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1u << bit % 8);
    PacketReader reader;
    reader.feed(bytes);
    reader.close();
    const auto read = reader.next();
    ASSERT_FALSE(read.has_value()) << bit;
    EXPECT_EQ(read.error().byte_offset, 4u);
    EXPECT_FALSE(reader.next().has_value()) << "the error stays";
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
  Bytes bytes;
  write_signature(bytes);
  write_packet(bytes, static_cast<PacketType>(200), random_bytes(9, 1));
  write_packet(bytes, PacketType::kEnd, Bytes{1});
  PacketReader reader;
  reader.feed(bytes);
  EXPECT_EQ(static_cast<int>(reader.next()->packet.type), 200);
  EXPECT_EQ(reader.next()->packet.type, PacketType::kEnd);
}

TEST(PacketReader, ResyncsBehindAnyDamagedByte) {
  const Stream s = sample_stream();
  for (std::size_t place = 4; place < s.begins[4]; ++place) {
    Bytes bytes = s.bytes;
    bytes[place] = static_cast<std::uint8_t>(bytes[place] ^ 0x55);
    PacketReader reader;
    reader.feed(bytes);
    reader.close();
    Result<ReadResult> last;
    auto offsets = offsets_until_stop(reader, last);
    ASSERT_FALSE(last.has_value()) << place;
    EXPECT_EQ(last.error().byte_offset, s.begins[offsets.size()]);
    const auto found = reader.resync();
    ASSERT_TRUE(found.has_value() && found->status == ReadStatus::kPacket) << place;
    EXPECT_EQ(found->packet.offset, s.begins[offsets.size() + 1]) << place;
    const auto rest = offsets_until_stop(reader, last);
    EXPECT_EQ(offsets.size() + 2 + rest.size(), s.begins.size());
    EXPECT_TRUE(last.has_value());
  }
}

TEST(PacketReader, ResyncsInAPipeAndMayJoinInTheMiddle) {
  const Stream s = sample_stream();
  PacketReader reader;
  std::vector<std::size_t> offsets;
  bool joined = false;
  for (std::size_t i = s.begins[1] + 100; i < s.bytes.size(); ++i) {
    reader.feed(std::span(s.bytes).subspan(i, 1));
    for (;;) {
      const auto read = joined ? reader.next() : reader.resync();
      ASSERT_TRUE(read.has_value());
      if (read->status != ReadStatus::kPacket) break;
      joined = true;
      offsets.push_back(read->packet.offset + s.begins[1] + 100);
    }
  }
  EXPECT_EQ(offsets, (std::vector<std::size_t>{s.begins[2], s.begins[3], s.begins[4]}));
}

TEST(PacketReader, ResyncEndsWhereNothingIsLeft) {
  Bytes bytes;
  write_signature(bytes);
  const Bytes junk(300, 0xFF);
  bytes.insert(bytes.end(), junk.begin(), junk.end());
  PacketReader reader;
  reader.feed(bytes);
  reader.close();
  EXPECT_FALSE(reader.next().has_value());
  EXPECT_EQ(reader.resync()->status, ReadStatus::kEnd);
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
    bool lost = false;
    while (steps++ < 5000) {
      const auto read = lost ? reader.resync() : reader.next();
      if (!read) {
        lost = true;
        continue;
      }
      if (read->status == ReadStatus::kPacket) {
        lost = false;
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
