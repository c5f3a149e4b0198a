#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "fbs/packet.h"
#include "tests/unit/library/api_decoder.h"

namespace fbs {
namespace {

struct Close {
  void operator()(fbs_packet_reader* reader) const { fbs_packet_reader_close(&reader); }
};
using Reader = std::unique_ptr<fbs_packet_reader, Close>;

Reader open_reader() {
  fbs_packet_reader* reader = nullptr;
  EXPECT_EQ(fbs_packet_reader_open(&reader), FBS_OK);
  return Reader(reader);
}

struct Packets {
  std::vector<fbs_packet_info> infos;  ///< without their faults
  std::vector<std::string> faults;
  std::vector<fbs_status> errors;
};

/// What a reader tells of a stream that comes in pieces.
Packets packets_of(const std::vector<std::uint8_t>& bytes, std::size_t piece) {
  const Reader reader = open_reader();
  Packets out;
  for (std::size_t fed = 0;;) {
    fbs_packet_info info;
    const fbs_status status = fbs_packet_reader_next(reader.get(), &info);
    if (status == FBS_END) return out;
    if (status < 0) {
      out.errors.push_back(status);
      EXPECT_STRNE(fbs_packet_reader_error(reader.get()), "");
    } else if (status == FBS_OK) {
      if (info.fault != nullptr) out.faults.emplace_back(info.fault);
      info.fault = nullptr;
      out.infos.push_back(info);
    } else if (fed == bytes.size()) {
      EXPECT_EQ(fbs_packet_reader_finish(reader.get()), FBS_OK);
    } else {
      const std::size_t size = std::min(piece, bytes.size() - fed);
      EXPECT_EQ(fbs_packet_reader_feed(reader.get(), bytes.data() + fed, size), FBS_OK);
      fed += size;
    }
  }
}

TEST(PacketApi, TellsWhatNeedsALostPacket) {
  const auto skipped = [](const std::vector<std::uint8_t>& bytes) {
    const Packets packets = packets_of(bytes, bytes.size());
    return std::count_if(packets.infos.begin(), packets.infos.end(),
                         [](const fbs_packet_info& p) { return p.skipped != 0; });
  };
  auto live = vector_bytes("live.fbs");
  EXPECT_EQ(skipped(live), 0);
  const Packets whole = packets_of(live, live.size());
  const auto at = [&](std::size_t k) {
    return live.begin() + static_cast<std::ptrdiff_t>(whole.infos[k].offset);
  };
  ASSERT_EQ(whole.infos[7].type, FBS_PACKET_UNIT);
  auto without_unit = live;
  without_unit.erase(without_unit.begin() + (at(7) - live.begin()),
                     without_unit.begin() + (at(8) - live.begin()));
  EXPECT_EQ(skipped(without_unit), 0) << "groups go on";
  auto twice = live;
  twice.insert(twice.begin() + (at(8) - live.begin()), at(7), at(8));
  EXPECT_EQ(skipped(twice), 1);
}

TEST(PacketApi, PacketsOfSoundStreamsFillThem) {
  for (const Vector& vector : read_vectors(FBS_VECTORS)) {
    if (vector.expected.error != "-") continue;
    SCOPED_TRACE(vector.file);
    const auto bytes = vector_bytes(vector.file);
    for (const std::size_t piece : {std::size_t{13}, bytes.size()}) {
      const Packets packets = packets_of(bytes, piece);
      std::uint64_t end = FBS_SIGNATURE_SIZE;
      for (const fbs_packet_info& p : packets.infos) {
        EXPECT_EQ(p.offset, end);
        EXPECT_EQ(p.type, bytes[p.offset]);
        end += p.size;
      }
      EXPECT_EQ(end, bytes.size());
      EXPECT_TRUE(packets.errors.empty());
      EXPECT_TRUE(packets.faults.empty());
    }
  }
}

// The decoder draws what it announces; the reader never decodes a pattern.
TEST(PacketApi, ReleasesThePicturesThatTheDecoderShows) {
  for (const Vector& vector : read_vectors(FBS_VECTORS)) {
    if (vector.expected.error != "-") continue;
    SCOPED_TRACE(vector.file);
    const auto bytes = vector_bytes(vector.file);
    const Heard shown = heard(bytes, bytes.size());
    std::size_t next = 0;
    for (const fbs_packet_info& p : packets_of(bytes, bytes.size()).infos) {
      if (p.pictures == 0) continue;
      while (next < shown.infos.size() && shown.infos[next].held != 0) ++next;
      ASSERT_LE(next + p.pictures, shown.infos.size());
      EXPECT_EQ(p.shown_from, shown.infos[next].time);
      next += p.pictures;
      EXPECT_EQ(p.shown_until, shown.infos[next - 1].time + shown.infos[next - 1].duration);
    }
    while (next < shown.infos.size() && shown.infos[next].held != 0) ++next;
    EXPECT_EQ(next, shown.infos.size());
  }
}

TEST(PacketApi, KeysAreWhereDecodingCanBegin) {
  const Packets packets = packets_of(vector_bytes("two_heads.fbs"), 1000);
  const auto setups = std::count_if(packets.infos.begin(), packets.infos.end(), [](const fbs_packet_info& p) {
    return p.type == FBS_PACKET_SETUP && p.key != 0;
  });
  EXPECT_GT(setups, 1);
}

TEST(PacketApi, DamageIsReportedOnceAndPassedOver) {
  auto bytes = vector_bytes("turns.fbs");
  const Packets whole = packets_of(bytes, bytes.size());
  const auto second = std::find_if(whole.infos.begin() + 1, whole.infos.end(), [](const fbs_packet_info& p) {
    return p.type == FBS_PACKET_SETUP || p.type == FBS_PACKET_END;
  });
  bytes[whole.infos[2].offset + 3] ^= 3;
  const Packets damaged = packets_of(bytes, 50);
  EXPECT_EQ(damaged.errors, std::vector{FBS_ERROR_DAMAGED});
  ASSERT_GT(damaged.infos.size(), 2u);
  EXPECT_EQ(damaged.infos[2].offset, second->offset);
}

TEST(PacketApi, StreamsMayBeJoinedAtAScene) {
  const auto bytes = vector_bytes("two_heads.fbs");
  const Packets joined = packets_of({bytes.begin() + FBS_SIGNATURE_SIZE, bytes.end()}, bytes.size());
  EXPECT_EQ(joined.errors, std::vector{FBS_ERROR_NOT_FBS});
  EXPECT_EQ(joined.infos.size(), packets_of(bytes, bytes.size()).infos.size());
  EXPECT_EQ(joined.infos.front().offset, 0u);
}

TEST(PacketApi, TellsTheFormatOnceThereIsASetup) {
  const auto bytes = vector_bytes("talk.fbs");
  const Reader reader = open_reader();
  fbs_format format;
  EXPECT_EQ(fbs_packet_reader_get_format(reader.get(), &format), FBS_NEED_DATA);
  ASSERT_EQ(fbs_packet_reader_feed(reader.get(), bytes.data(), bytes.size()), FBS_OK);
  fbs_packet_info info;
  ASSERT_EQ(fbs_packet_reader_next(reader.get(), &info), FBS_OK);
  ASSERT_EQ(fbs_packet_reader_get_format(reader.get(), &format), FBS_OK);
  EXPECT_GE(format.width, unsigned{FBS_MIN_SIDE});
  ASSERT_EQ(fbs_packet_reader_reset(reader.get()), FBS_OK);
  EXPECT_EQ(fbs_packet_reader_get_format(reader.get(), &format), FBS_NEED_DATA);
}

TEST(PacketApi, RefusesCallsThatMakeNoSense) {
  fbs_packet_info info;
  EXPECT_EQ(fbs_packet_reader_open(nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_packet_reader_next(nullptr, &info), FBS_ERROR_ARGUMENT);
  const Reader reader = open_reader();
  EXPECT_EQ(fbs_packet_reader_next(reader.get(), nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_packet_reader_feed(reader.get(), nullptr, 1), FBS_ERROR_ARGUMENT);
  ASSERT_EQ(fbs_packet_reader_finish(reader.get()), FBS_OK);
  const std::uint8_t byte = 0;
  EXPECT_EQ(fbs_packet_reader_feed(reader.get(), &byte, 1), FBS_ERROR_ARGUMENT);
}

}  // namespace
}  // namespace fbs
