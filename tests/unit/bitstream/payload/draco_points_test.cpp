#include "bitstream/payload/draco_points.h"

#include <gtest/gtest.h>

#include <random>

namespace fbs {
namespace {

HeadPoints random_points(int reach) {
  std::mt19937 random(2);
  HeadPoints points(105);
  for (auto& p : points)
    for (int axis = 0; axis < 3; ++axis) p[axis] = static_cast<int>(random() % (2 * reach + 1)) - reach;
  return points;
}

TEST(DracoPoints, KeepOrderAndValues) {
  for (const int reach : {0, 1, 40, 1 << 19}) {
    const HeadPoints points = random_points(reach);
    const auto bytes = encode_points(points);
    ASSERT_TRUE(bytes) << bytes.error().text;
    EXPECT_EQ(*decode_points(*bytes, points.size()), points) << reach;
  }
}

// The bytes do not say how many points there are.
TEST(DracoPoints, AreAsManyAsAskedFor) {
  const auto bytes = *encode_points(random_points(40));
  for (const std::size_t count : {1, 104, 106, 1024})
    if (const auto points = decode_points(bytes, count)) {
      EXPECT_EQ(points->size(), count);
    }
}

TEST(DracoPoints, ReportWhatDracoCannotDecode) {
  const auto nothing = decode_points({}, 105);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, ErrorCode::kInvalidStream);
  const auto bytes = *encode_points(random_points(40));
  const auto cut = decode_points(std::span(bytes).first(3), 105);
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, ErrorCode::kInvalidStream);
}

}  // namespace
}  // namespace fbs
