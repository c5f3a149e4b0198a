// Four look-ups at a time against the scalar one.
#include "encoder/track/snake/map_lookup.h"

#include <gtest/gtest.h>

#include <random>

#include "encoder/image/bilinear.h"

namespace fbs {
namespace {

TEST(MapLookup, IsFourScalarLookups) {
  std::mt19937 random(5);
  const auto share = [&] { return static_cast<float>(random() % 10000) / 10000; };
  cv::Mat1f map(12, 15);
  for (float& v : map) v = share();
  for (int i = 0; i < 50; ++i) {
    alignas(16) float x[4], y[4], value[4], by_x[4], by_y[4];
    for (std::size_t l = 0; l < 4; ++l) {
      x[l] = 13.9F * share();
      y[l] = 10.9F * share();
    }
    const MapLookup found = MapPlace(map, cv::v_load_aligned(x), cv::v_load_aligned(y)).in(map);
    cv::v_store_aligned(value, found.value);
    cv::v_store_aligned(by_x, found.by_x);
    cv::v_store_aligned(by_y, found.by_y);
    for (std::size_t l = 0; l < 4; ++l) {
      const BilinearCell cell(glm::vec2(x[l], y[l]));
      EXPECT_NEAR(value[l], bilinear<float>(map, cell), 1e-5);
      const float *a = map[cell.row] + cell.column, *b = map[cell.row + 1] + cell.column;
      EXPECT_NEAR(by_x[l], mix(a[1] - a[0], b[1] - b[0], cell.fraction.y), 1e-5);
      EXPECT_NEAR(by_y[l], mix(b[0] - a[0], b[1] - a[1], cell.fraction.x), 1e-5);
    }
  }
}

TEST(MapLookup, RepeatsTheBorderWithoutSlope) {
  cv::Mat1f map(6, 6);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 6; ++x) map(y, x) = static_cast<float>(x + 10 * y);
  alignas(16) const float x[4] = {-3, 2, 50, 2}, y[4] = {2, -7, 2, 2};
  const MapLookup found = MapPlace(map, cv::v_load_aligned(x), cv::v_load_aligned(y)).in(map);
  alignas(16) float value[4], by_x[4], by_y[4];
  cv::v_store_aligned(value, found.value);
  cv::v_store_aligned(by_x, found.by_x);
  cv::v_store_aligned(by_y, found.by_y);
  EXPECT_FLOAT_EQ(value[0], 20);
  EXPECT_FLOAT_EQ(value[1], 2);
  EXPECT_NEAR(value[2], 25, 0.01);
  EXPECT_EQ(by_x[0], 0);
  EXPECT_FLOAT_EQ(by_y[0], 10);
  EXPECT_EQ(by_y[1], 0);
  EXPECT_EQ(by_x[2], 0);
  EXPECT_FLOAT_EQ(by_x[3], 1);
}

}  // namespace
}  // namespace fbs
