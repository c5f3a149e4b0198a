#include "encoder/patterns/face_chroma.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fbs {
namespace {

/// A head between 20 and 60 pixels each way.
std::array<glm::ivec3, kVertexCount> head() {
  std::array<glm::ivec3, kVertexCount> out{};
  std::fill(out.begin(), out.end(), glm::ivec3(64 * 40));
  out[3] = {64 * 20, 64 * 60, 0};
  out[7] = {64 * 60, 64 * 20, 0};
  return out;
}

Picture coloured(std::uint8_t u, std::uint8_t v) {
  Picture out(80, 80);
  std::fill(out.u.samples.begin(), out.u.samples.end(), u);
  std::fill(out.v.samples.begin(), out.v.samples.end(), v);
  return out;
}

std::int32_t contrast_of(const Picture& picture) {
  FaceChroma chroma;
  chroma.add(picture, head());
  return chroma.contrast();
}

TEST(FaceChroma, NothingSeenIsLeftAsItIs) {
  EXPECT_EQ(FaceChroma().contrast(), kContrastOne);
}

TEST(FaceChroma, PaleFacesGetWhatIsWanted) {
  EXPECT_EQ(contrast_of(coloured(128, 128)), kWantedChromaContrast);
  EXPECT_EQ(contrast_of(coloured(118, 150)), kWantedChromaContrast);
}

TEST(FaceChroma, CodedSamplesStayInRange) {
  for (const int v : {204, 212, 225, 239}) {
    const std::int32_t contrast = contrast_of(coloured(128, static_cast<std::uint8_t>(v)));
    EXPECT_LE((v - 128) * contrast / kContrastOne, 112) << v;
    EXPECT_GT((v - 128) * (contrast + 4) / kContrastOne, 108) << v << ": as much as there is room for";
    EXPECT_EQ(contrast % 2, 0);
  }
  EXPECT_EQ(contrast_of(coloured(0, 128)), kContrastOne);
}

TEST(FaceChroma, LipsCountAndAFewSamplesDoNot) {
  Picture lips = coloured(128, 140), speck = lips;
  for (int y = 22; y < 24; ++y) std::fill_n(lips.v.row(y) + 18, 6, 210);  // 3 % of the face
  speck.v.row(22)[18] = 210;
  EXPECT_LT(contrast_of(lips), kWantedChromaContrast);
  EXPECT_EQ(contrast_of(speck), kWantedChromaContrast);
}

TEST(FaceChroma, WhatIsOutsideTheHeadDoesNotCount) {
  Picture p = coloured(128, 140);
  for (int y = 0; y < 8; ++y) std::fill_n(p.v.row(y), 40, 240);
  EXPECT_EQ(contrast_of(p), kWantedChromaContrast);
}

TEST(FaceChroma, HeadsMayReachBeyondThePicture) {
  FaceChroma chroma;
  auto far = head();
  far[3] = {-64 * 500, -64 * 500, 0};
  far[7] = {64 * 500, 64 * 500, 0};
  chroma.add(coloured(128, 228), far);
  EXPECT_LT(chroma.contrast(), kWantedChromaContrast);
}

}  // namespace
}  // namespace fbs
