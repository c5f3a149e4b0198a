#include "encoder/patterns/mouth_colours.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

constexpr int kOpen = 24, kShut = 10;  // pixels between the outer lips' middles
constexpr double kEyeDistance = 64;

std::array<glm::ivec3, kVertexCount> lips(int height) {
  std::array<glm::ivec3, kVertexCount> at{};
  const auto set = [&](int landmark, int y) { at[vertex_of_landmark(landmark)] = {64 * 40, 64 * y, 0}; };
  set(51, 40);
  set(62, 43);
  set(57, 40 + height);
  return at;
}

/// Teeth of one colour above, a dark tongue of another below.
Picture open_mouth(std::uint8_t teeth_u, std::uint8_t tongue_u) {
  Picture p(80, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) p.y.row(y)[x] = static_cast<std::uint8_t>(y < 50 ? 180 : y < 54 ? 30 : 90);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) p.u.row(y)[x] = y < 25 ? teeth_u : tongue_u;
  return p;
}

const std::int32_t kRest = mouth_height(lips(kShut));

TEST(MouthColours, HeightIsBetweenTheOuterLips) {
  EXPECT_EQ(kRest, 64 * kShut);
}

TEST(MouthColours, AreMeansOfOpenMouths) {
  MouthColours colours(kRest, kEyeDistance);
  for (const int by : {-4, 0, 4})
    colours.add(open_mouth(static_cast<std::uint8_t>(120 + by), static_cast<std::uint8_t>(140 + by)),
                lips(kOpen));
  MouthInterior mouth;
  colours.set_chroma(mouth);
  EXPECT_EQ(mouth.upper.u, 120);
  EXPECT_EQ(mouth.lower.u, 140);
  EXPECT_EQ(mouth.upper.v, 128);
}

TEST(MouthColours, LeaveLumaAlone) {
  MouthColours colours(kRest, kEyeDistance);
  for (int i = 0; i < 5; ++i) colours.add(open_mouth(120, 140), lips(kOpen));
  MouthInterior mouth;
  colours.set_chroma(mouth);
  EXPECT_EQ(mouth.upper.y, MouthInterior{}.upper.y);
  EXPECT_EQ(mouth.lower.y, MouthInterior{}.lower.y);
}

TEST(MouthColours, NeedThreeOpenMouths) {
  MouthColours colours(kRest, kEyeDistance);
  for (int i = 0; i < 9; ++i) colours.add(open_mouth(90, 90), lips(kShut));
  for (int i = 0; i < 2; ++i) colours.add(open_mouth(90, 90), lips(kOpen));
  MouthInterior mouth;
  colours.set_chroma(mouth);
  EXPECT_EQ(mouth, MouthInterior{});
}

TEST(MouthColours, IgnoreMouthsOutsideThePicture) {
  MouthColours colours(kRest, kEyeDistance);
  auto outside = lips(kOpen);
  for (glm::ivec3& p : outside) p.x -= 64 * 200;
  for (int i = 0; i < 5; ++i) colours.add(open_mouth(90, 90), outside);
  MouthInterior mouth;
  colours.set_chroma(mouth);
  EXPECT_EQ(mouth, MouthInterior{});
}

}  // namespace
}  // namespace fbs
