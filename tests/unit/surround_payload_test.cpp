#include "bitstream/surround_payload.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

namespace fbs {
namespace {

// An oval that follows the head in the middle of still ground, with a soft rim.
SurroundMap oval(int columns, int rows) {
  SurroundMap map{columns, rows, {}};
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x) {
      const int dx = (2 * x - columns) * 100 / columns;
      const int dy = (2 * y - rows) * 100 / rows;
      const int follow = kFollowOne + 4 - (dx * dx + dy * dy) / 500;
      map.follow.push_back(static_cast<std::uint8_t>(std::clamp(follow, 0, kFollowOne)));
    }
  }
  return map;
}

TEST(SurroundPayload, RoundTripsSmoothAndRandomMaps) {
  std::mt19937 random(1);
  for (const auto& [columns, rows] :
       {std::pair{1, 1}, std::pair{22, 18}, std::pair{128, 128}, std::pair{3, 100}}) {
    SurroundMap map = oval(columns, rows);
    const auto payload = encode_surround(map);
    ASSERT_TRUE(payload);
    EXPECT_EQ(*decode_surround(*payload), map);
    for (auto& value : map.follow) value = static_cast<std::uint8_t>(random() % (kFollowOne + 1));
    EXPECT_EQ(*decode_surround(*encode_surround(map)), map);
  }
}

TEST(SurroundPayload, CostsLittleWhereNeighboursAgree) {
  SurroundMap still{22, 18, std::vector<std::uint8_t>(23 * 19, 0)};
  EXPECT_LE(encode_surround(still)->size(), 3u);
  EXPECT_LT(encode_surround(oval(22, 18))->size(), 75u);
}

TEST(SurroundPayload, ChecksEveryBound) {
  const auto code_of = [](const SurroundMap& map) {
    const auto payload = encode_surround(map);
    return payload ? ErrorCode::kInternal : payload.error().code;
  };
  EXPECT_EQ(code_of({0, 1, {0, 0}}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of({129, 1, std::vector<std::uint8_t>(260)}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of({1, 1, {0, 0, 0}}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of({1, 1, {0, 0, 0, kFollowOne + 1}}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(decode_surround(std::vector<std::uint8_t>{0, 4}).error().code, ErrorCode::kInvalidStream);
  EXPECT_EQ(decode_surround(std::vector<std::uint8_t>{4, 0x81, 1}).error().code, ErrorCode::kTooLarge);
  EXPECT_EQ(decode_surround(std::vector<std::uint8_t>{4}).error().code, ErrorCode::kTruncated);
  EXPECT_EQ(decode_surround(std::vector<std::uint8_t>{1, 1, 1, 2, 3, 4, 5, 6, 7, 8}).error().code,
            ErrorCode::kInvalidStream);
}

TEST(SurroundPayload, SurvivesRandomBytes) {
  std::mt19937 random(4);
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::uint8_t> payload(random() % 60);
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random());
    if (payload.size() > 2) payload[0] = payload[1] = static_cast<std::uint8_t>(1 + random() % 20);
    if (const auto map = decode_surround(payload)) {
      for (const auto value : map->follow) EXPECT_LE(value, kFollowOne);
    }
  }
}

}  // namespace
}  // namespace fbs
