#include "bitstream/payload/geometry_payload.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

namespace fbs {
namespace {

Geometry plausible_geometry(unsigned seed, double sigma_steps = 6) {
  std::mt19937 random(seed);
  std::normal_distribution<double> residual(0, sigma_steps * kDefaultGeometryStep);
  Geometry geometry;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    const glm::ivec3 p = generic_head().vertices[v].position;
    geometry.positions[v] = {p.x * 11 / 10 + static_cast<int>(residual(random)),
                             p.y * 9 / 10 + static_cast<int>(residual(random)),
                             p.z + (random() % 10 < 7 ? 0 : static_cast<int>(residual(random)))};
  }
  return geometry;
}

TEST(GeometryPayload, DecodesToTheHeadThatTheEncoderReturned) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto coded = encode_geometry(plausible_geometry(seed));
    ASSERT_TRUE(coded);
    EXPECT_LT(coded->payload.size(), 260u);
    const auto decoded = decode_geometry(coded->payload);
    ASSERT_TRUE(decoded);
    EXPECT_EQ(*decoded, coded->decoded);
  }
}

TEST(GeometryPayload, KeepsTheVertexOrderWithinHalfAStep) {
  for (const std::int32_t step : {1, 7, 16, 200}) {
    const Geometry geometry = plausible_geometry(3);
    const auto coded = encode_geometry(geometry, step);
    ASSERT_TRUE(coded);
    const auto decoded = decode_geometry(coded->payload);
    ASSERT_TRUE(decoded);
    for (std::size_t v = 0; v < kVertexCount; ++v) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(std::abs(decoded->positions[v][axis] - geometry.positions[v][axis]) * 2, step) << v;
      }
    }
  }
}

TEST(GeometryPayload, SmoothAdaptationCostsLessThanNoise) {
  Geometry smooth;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    const glm::ivec3 p = generic_head().vertices[v].position;
    smooth.positions[v] = p + glm::ivec3(static_cast<int>(200 * std::sin(p.y / 3000.0)),
                                         static_cast<int>(150 * std::cos(p.x / 3000.0)), 0);
  }
  EXPECT_LT(encode_geometry(smooth)->payload.size(), encode_geometry(plausible_geometry(1))->payload.size());
  Geometry generic;
  for (std::size_t v = 0; v < kVertexCount; ++v) generic.positions[v] = generic_head().vertices[v].position;
  EXPECT_LT(encode_geometry(generic)->payload.size(), 30u);
}

TEST(GeometryPayload, CodesTheFarthestCorners) {
  std::mt19937 random(5);
  Geometry geometry;
  for (auto& p : geometry.positions) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = (random() & 1) != 0 ? kMaxCoordinate : -kMaxCoordinate;
  }
  for (const std::int32_t step : {1, 16, kMaxGeometryStep}) {
    const auto coded = encode_geometry(geometry, step);
    ASSERT_TRUE(coded);
    EXPECT_LE(coded->payload.size(), kMaxGeometryPayload);
    EXPECT_EQ(*decode_geometry(coded->payload), coded->decoded);
  }
}

TEST(GeometryPayload, ChecksEveryBound) {
  Geometry far = plausible_geometry(1);
  far.positions[50].y = kMaxCoordinate + 1;
  EXPECT_EQ(encode_geometry(far).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(encode_geometry(plausible_geometry(1), 0).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(encode_geometry(plausible_geometry(1), kMaxGeometryStep + 1).error().code,
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(decode_geometry(std::vector<std::uint8_t>(kMaxGeometryPayload + 1)).error().code,
            ErrorCode::kTooLarge);
  EXPECT_EQ(decode_geometry({}).error().code, ErrorCode::kTruncated);
  EXPECT_EQ(decode_geometry(std::vector<std::uint8_t>{0, 1, 1, 1, 0}).error().code,
            ErrorCode::kInvalidStream);
  EXPECT_EQ(decode_geometry(std::vector<std::uint8_t>{1, 1, 1, 0, 0}).error().code,
            ErrorCode::kInvalidStream);
  EXPECT_EQ(decode_geometry(std::vector<std::uint8_t>{1, 1, 1, 1, 3}).error().code,
            ErrorCode::kInvalidStream);
  EXPECT_EQ(decode_geometry(std::vector<std::uint8_t>{1, 1, 1, 1, 0}).error().code,
            ErrorCode::kInvalidStream);
}

TEST(GeometryPayload, SurvivesTruncationAndRandomBytes) {
  const auto good = encode_geometry(plausible_geometry(2))->payload;
  for (std::size_t size = 0; size < good.size(); ++size) {
    if (const auto read = decode_geometry(std::span(good).first(size))) continue;
  }
  std::mt19937 random(6);
  for (int i = 0; i < 5000; ++i) {
    auto payload = good;
    for (unsigned k = 1 + random() % 4; k > 0; --k) {
      payload[random() % payload.size()] = static_cast<std::uint8_t>(random());
    }
    if (const auto read = decode_geometry(payload)) {
      for (const auto& p : read->positions) {
        for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(p[axis]), kMaxCoordinate);
      }
    }
  }
}

}  // namespace
}  // namespace fbs
