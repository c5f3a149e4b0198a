#include "encoder/scene/scene_packets.h"

#include <gtest/gtest.h>

#include "bitstream/packet.h"

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Types of the packets that a scene has written.
std::vector<PacketType> types_of(const Bytes& packets) {
  Bytes stream;
  write_signature(stream);
  stream.insert(stream.end(), packets.begin(), packets.end());
  PacketReader reader;
  reader.feed(stream);
  reader.close();
  std::vector<PacketType> types;
  for (auto read = reader.next(); read && read->status == ReadStatus::kPacket; read = reader.next())
    types.push_back(read->packet.type);
  return types;
}

const Bytes kPayload = {1, 2, 3};

TEST(ScenePackets, HoldsMotionBackUntilTheSceneStarts) {
  ScenePackets packets;
  packets.add_motion(kPayload);
  EXPECT_FALSE(packets.started());
  EXPECT_TRUE(packets.take().empty());
  packets.start({kPayload, kPayload, kPayload, kPayload});
  EXPECT_TRUE(packets.started());
  packets.add_motion(kPayload);
  EXPECT_EQ(types_of(packets.take()),
            (std::vector{PacketType::kSetup, PacketType::kGeometry, PacketType::kSurround,
                         PacketType::kPattern, PacketType::kMotion, PacketType::kMotion}));
  EXPECT_TRUE(packets.take().empty()) << "they are forgotten";
}

TEST(ScenePackets, CountsWhatIsWrittenWhetherTakenOrNot) {
  ScenePackets packets;
  packets.start({kPayload, {}, {}, kPayload});
  EXPECT_EQ(packets.counted(), 2 * packet_size(kPayload.size()));
  packets.count_from_here();
  EXPECT_EQ(packets.counted(), 0U);
  packets.add_motion(kPayload);
  EXPECT_EQ(packets.take().size(), 3 * packet_size(kPayload.size()));
  packets.add_motion(kPayload);
  EXPECT_EQ(packets.counted(), 2 * packet_size(kPayload.size()));
}

// Their checks fit the place where they are written.
TEST(ScenePackets, HoldsBackAgainInTheNextScene) {
  ScenePackets packets;
  for (int scene = 0; scene < 2; ++scene) {
    packets.add_motion(kPayload);
    packets.add_motion(kPayload);
    packets.start({kPayload, {}, {}, kPayload});
    EXPECT_EQ(types_of(packets.take()), (std::vector{PacketType::kSetup, PacketType::kPattern,
                                                     PacketType::kMotion, PacketType::kMotion}));
    packets.begin_again();
  }
}

TEST(ScenePackets, LeavesOutWhatTheSceneLacks) {
  ScenePackets packets;
  packets.start({kPayload, {}, {}, kPayload});
  EXPECT_EQ(types_of(packets.take()), (std::vector{PacketType::kSetup, PacketType::kPattern}));
}

}  // namespace
}  // namespace fbs
