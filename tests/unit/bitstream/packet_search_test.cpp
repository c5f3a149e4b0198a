#include "bitstream/packet_search.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "bitstream/packet.h"

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Random bytes, then a packet.
Bytes noise_and_packet(std::size_t noise, std::size_t payload, PacketType type = PacketType::kMotion) {
  std::mt19937 random(3);
  Bytes bytes(noise);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  write_packet(bytes, type, Bytes(payload, 0x5A));
  return bytes;
}

TEST(PacketSearch, FindsAPacketAfterNoise) {
  for (const std::size_t noise : {0u, 1u, 5u, 300u}) {
    const Bytes bytes = noise_and_packet(noise, 100);
    PacketSearch search(0);
    EXPECT_EQ(search.find(bytes, true), noise);
  }
}

// SPEC 3.1
TEST(PacketSearch, FindsThePacketsOfTheListAlone) {
  const int first = static_cast<int>(PacketType::kSetup), last = static_cast<int>(PacketType::kBlend);
  for (int type = first - 1; type <= last + 1; ++type)
    EXPECT_EQ(PacketSearch(0).find(noise_and_packet(0, 9, static_cast<PacketType>(type)), true).has_value(),
              type >= first && type <= last)
        << type;
}

TEST(PacketSearch, ContinuesWhereBytesWereMissing) {
  const Bytes bytes = noise_and_packet(300, 100);
  PacketSearch search(0);
  for (std::size_t size = 1; size < bytes.size(); ++size)
    ASSERT_FALSE(search.find(std::span(bytes).first(size), false)) << size;
  EXPECT_EQ(search.find(bytes, true), 300u);
}

TEST(PacketSearch, PositionsFollowDroppedBytes) {
  const Bytes bytes = noise_and_packet(300, 100);
  PacketSearch search(0);
  ASSERT_FALSE(search.find(std::span(bytes).first(350), false));
  const std::size_t dropped = search.first_open();
  EXPECT_LE(dropped, 300u);
  search.drop_front(dropped);
  EXPECT_EQ(search.find(std::span(bytes).subspan(dropped), true), 300 - dropped);
}

// SPEC 3.2
TEST(PacketSearch, IgnoresPayloadsThatAreTooLong) {
  EXPECT_TRUE(PacketSearch(0).find(noise_and_packet(0, kMaxSearchedPayload), true));
  EXPECT_FALSE(PacketSearch(0).find(noise_and_packet(0, kMaxSearchedPayload + 1), true));
}

// Every fourth byte begins a header of a long packet: testing each on its own would take quadratic time.
TEST(PacketSearch, IsLinearOnHostileBytes) {
  Bytes bytes(1 << 20);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = i % 4 == 0 ? 5 : i % 4 == 3 ? 0x3F : 0xFF;
  PacketSearch search(0);
  EXPECT_FALSE(search.find(bytes, true).has_value());
}

}  // namespace
}  // namespace fbs
