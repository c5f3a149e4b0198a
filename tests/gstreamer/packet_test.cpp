#include "gstreamer/packet.h"

#include <gtest/gtest.h>

#include <string_view>
#include <utility>

#include "tests/gstreamer/stream.h"

namespace fbs::gstreamer {
namespace {

TEST(FbsPacket, CheckIsThatOfTheFormat) {
  const std::string_view digits = "123456789";  // SPEC 3.1
  EXPECT_EQ(gst_fbs_crc16(0xFFFF, reinterpret_cast<const guint8*>(digits.data()), digits.size()), 0x29B1);
}

TEST(FbsPacket, VarintsHaveSevenBitsInAByteTheLowestFirst) {
  const std::vector<std::pair<Bytes, guint64>> cases = {
      {{0}, 0},
      {{127}, 127},
      {{0x80, 1}, 128},
      {{0xE0, 0xA7, 0x12}, 300000},
      {{0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 1}, ~guint64{0}}};
  for (const auto& [bytes, value] : cases) {
    gsize at = 0;
    guint64 read = 1;
    EXPECT_TRUE(gst_fbs_read_varint(bytes.data(), bytes.size(), &at, &read));
    EXPECT_EQ(read, value);
    EXPECT_EQ(at, bytes.size());
  }
}

TEST(FbsPacket, LongOrWastefulVarintsAreMalformed) {
  const Bytes two = {0x81, 0x00}, eleven(11, 0x80),
              large = {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 2};
  for (const Bytes& bytes : {two, eleven, large}) {
    gsize at = 0;
    guint64 read = 0;
    EXPECT_FALSE(gst_fbs_read_varint(bytes.data(), bytes.size(), &at, &read));
  }
}

TEST(FbsPacket, ACutPacketIsShortAndALongOneIsDamaged) {
  const Bytes stream = joined(encoded(1));
  GstFbsPacket packet;
  for (gsize size = 0; size < stream.size() - 4; ++size) {
    gsize needed = 0;
    if (gst_fbs_packet_scan(stream.data() + 4, size, &packet, &needed) != GST_FBS_SCAN_SHORT) break;
    EXPECT_GT(needed, size);
  }
  const Bytes too_long = {1, 0x81, 0x80, 0x80, 0x08, 0, 0, 0, 0};  // 2^24 + 1
  EXPECT_EQ(gst_fbs_packet_scan(too_long.data(), too_long.size(), &packet, nullptr), GST_FBS_SCAN_DAMAGED);
}

TEST(FbsPacket, TheSetupSaysTheFormat) {
  const Bytes stream = joined(encoded(1));
  GstFbsSetup setup;
  ASSERT_TRUE(gst_fbs_find_setup(stream.data() + 4, stream.size() - 4, &setup));
  EXPECT_EQ(setup.version, fbs_format_version());
  EXPECT_EQ(setup.width, static_cast<guint64>(kSide));
  EXPECT_EQ(setup.rate_num, static_cast<guint64>(kRate));
  EXPECT_EQ(setup.pictures_before, 0U);
}

TEST(FbsPacket, ARestartIsASetupOrAnEnd) {
  const std::vector<Buffer> groups = encoded(20, {10});
  const Bytes stream = joined(groups);
  gsize expected = 0;
  for (const Buffer& group : groups) {
    if (expected > 0 && is_key(group)) break;
    expected += gst_buffer_get_size(group.get());
  }
  EXPECT_EQ(5 + gst_fbs_find_restart(stream.data() + 5, stream.size() - 5), expected);
}

}  // namespace
}  // namespace fbs::gstreamer
