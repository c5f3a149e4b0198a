#include "bitstream/payload/surround_payload.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

namespace fbs {
namespace {

// An oval that follows the head in the middle of still ground, with a soft rim.
SurroundMap oval(int columns, int rows) {
  SurroundMap map{columns, rows, {}, std::vector<std::uint8_t>((columns + 1) * (rows + 1), 0)};
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x) {
      const int dx = (2 * x - columns) * 100 / columns;
      const int dy = (2 * y - rows) * 100 / rows;
      const int share = kFollowOne + 4 - (dx * dx + dy * dy) / 500;
      map.head.push_back(static_cast<std::uint8_t>(std::clamp(share, 0, kFollowOne)));
    }
  }
  return map;
}

// The same with shoulders: the lower third, where a point does not follow the head entirely.
SurroundMap oval_with_shoulders(int columns, int rows) {
  SurroundMap map = oval(columns, rows);
  for (std::size_t k = map.body.size() * 2 / 3; k < map.body.size(); ++k)
    if (map.head[k] < kFollowOne) map.body[k] = kFollowOne;
  return map;
}

SurroundMap random_map(std::mt19937& random, int columns, int rows) {
  SurroundMap map = oval(columns, rows);
  for (auto& value : map.head) value = static_cast<std::uint8_t>(random() % (kFollowOne + 1));
  for (std::size_t k = 0; k < map.body.size(); ++k)
    if (map.head[k] < kFollowOne) map.body[k] = static_cast<std::uint8_t>(random() % (kFollowOne + 1));
  return map;
}

TEST(SurroundPayload, RoundTripsSmoothAndRandomMaps) {
  std::mt19937 random(1);
  for (const auto& [columns, rows] :
       {std::pair{1, 1}, std::pair{22, 18}, std::pair{128, 128}, std::pair{3, 100}}) {
    for (const SurroundMap& map : {oval(columns, rows), oval_with_shoulders(columns, rows),
                                   random_map(random, columns, rows), random_map(random, columns, rows)}) {
      const auto payload = encode_surround(map);
      ASSERT_TRUE(payload);
      EXPECT_EQ(*decode_surround(*payload), map);
    }
  }
}

TEST(SurroundPayload, CostsLittleWhereNeighboursAgree) {
  const std::vector<std::uint8_t> none(23 * 19, 0);
  EXPECT_LE(encode_surround({22, 18, none, none})->size(), 3u);
  const std::size_t head = encode_surround(oval(22, 18))->size();
  EXPECT_LT(head, 75u);
  const std::size_t both = encode_surround(oval_with_shoulders(22, 18))->size();
  EXPECT_GT(both, head);
  EXPECT_LT(both, head + 25);
}

// A point that follows the head entirely has no body value to code.
TEST(SurroundPayload, BodyUnderTheHeadIsNotCoded) {
  SurroundMap map = oval(22, 18);
  map.head.assign(map.head.size(), kFollowOne);
  const std::size_t none = encode_surround(map)->size();
  map.head.back() = 0;
  map.body.back() = kFollowOne;
  EXPECT_LE(encode_surround(map)->size(), none + 4) << "one point alone can have one";
  EXPECT_EQ(*decode_surround(*encode_surround(map)), map);
}

TEST(SurroundPayload, ChecksEveryBound) {
  const auto code_of = [](const SurroundMap& map) {
    const auto payload = encode_surround(map);
    return payload ? ErrorCode::kInternal : payload.error().code;
  };
  const std::vector<std::uint8_t> none(4, 0), many(260, 0);
  EXPECT_EQ(code_of({1, 1, none, none}), ErrorCode::kInternal) << "all else is in order";
  EXPECT_EQ(code_of({0, 1, {0, 0}, {0, 0}}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of({129, 1, many, many}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of({1, 1, {0, 0, 0}, none}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of({1, 1, none, {0, 0, 0}}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of({1, 1, {0, 0, 0, kFollowOne + 1}, none}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of({1, 1, none, {kFollowOne + 1, 0, 0, 0}}), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of({1, 1, {kFollowOne, 0, 0, 0}, {1, 0, 0, 0}}), ErrorCode::kInvalidArgument);
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
      ASSERT_EQ(map->head.size(), map->body.size());
      for (std::size_t k = 0; k < map->head.size(); ++k) {
        EXPECT_LE(map->head[k], kFollowOne);
        EXPECT_LE(map->body[k], map->head[k] == kFollowOne ? 0 : kFollowOne);
      }
    }
  }
}

}  // namespace
}  // namespace fbs
