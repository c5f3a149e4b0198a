#include "decoder/head/face_light.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "decoder/head/head_mesh.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

/// What the light of `state` adds at each vertex of the toy head.
std::vector<VertexLight> light_of(const State& state) {
  return vertex_lights(toy_geometry().positions, kRingCount, state.light);
}

TEST(FaceLight, IsThatOfTheNeutralVertexAndEndsAtTheRing) {
  State state = toy_state();
  state.light = {160, -48, 200, -300};
  const auto light = light_of(state);
  ASSERT_EQ(light.size(), generic_head_mesh().vertex_count);
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    const glm::dvec3 p = glm::dvec3(toy_geometry().positions[v]) / 4096.0;
    EXPECT_NEAR(light[v].offset, 160 + 200 * p.x - 300 * p.y, 0.501) << v;
    EXPECT_EQ(light[v].gain, -48);
  }
  for (std::size_t v = kVertexCount; v < light.size(); ++v)
    EXPECT_TRUE(light[v].offset == 0 && light[v].gain == 0) << "ring " << v;
}

TEST(FaceLight, IsClampedAndEmptyWhenThereIsNone) {
  EXPECT_TRUE(light_of(toy_state()).empty());
  State state = toy_state();
  state.light = {kMaxLight, 0, kMaxLight, kMaxLight};
  int clamped = 0;
  for (const VertexLight& l : light_of(state)) {
    EXPECT_LE(std::abs(l.offset), kMaxLight);
    clamped += l.offset == kMaxLight ? 1 : 0;
  }
  EXPECT_GT(clamped, 20) << "the case must occur";
}

// u^2, v^2 and u v eye distances from the middle of the face.
TEST(FaceLight, QuadraticTermsAreAboutTheMiddleOfTheFace) {
  const auto at = [](LightIndex index, double u, double v) {
    std::array<std::int32_t, kLightCount> light{};
    light[index] = 1600;
    const auto units = [](double eye_distances) {
      return static_cast<int>(eye_distances * kUnitsPerEyeDistance);
    };
    return light_at({units(u), units(v) + kFaceMiddle, 1234}, light).offset;
  };
  for (const LightIndex i : {kLightQuadraticXX, kLightQuadraticYY, kLightQuadraticXY})
    EXPECT_EQ(at(i, 0, 0), 0);
  EXPECT_EQ(at(kLightQuadraticXX, 0.5, 0.75), 400);
  EXPECT_EQ(at(kLightQuadraticYY, 0.5, 0.75), 900);
  EXPECT_EQ(at(kLightQuadraticXY, 0.5, 0.75), 600);
  EXPECT_EQ(at(kLightQuadraticXY, -0.5, 0.75), -600);
}

}  // namespace
}  // namespace fbs
