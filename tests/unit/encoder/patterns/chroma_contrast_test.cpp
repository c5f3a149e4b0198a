#include "encoder/patterns/chroma_contrast.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bitstream/syntax.h"

namespace fbs {
namespace {

Picture coloured(std::uint8_t u, std::uint8_t v) {
  Picture out(80, 80);
  std::fill(out.u.samples.begin(), out.u.samples.end(), u);
  std::fill(out.v.samples.begin(), out.v.samples.end(), v);
  return out;
}

constexpr std::int32_t kMost = kContrastOne * 3 / 2;

std::int32_t contrast_of(const Picture& picture) {
  ChromaContrast chroma(kMost);
  chroma.add(picture);
  return chroma.contrast();
}

TEST(ChromaContrast, NothingSeenIsLeftAsItIs) {
  EXPECT_EQ(ChromaContrast(kMost).contrast(), kContrastOne);
}

TEST(ChromaContrast, PaleScenesGetWhatIsWanted) {
  EXPECT_EQ(contrast_of(coloured(128, 128)), kMost);
  EXPECT_EQ(contrast_of(coloured(118, 150)), kMost);
}

TEST(ChromaContrast, CodedSamplesStayInRange) {
  for (const int v : {204, 212, 225, 239}) {
    const std::int32_t contrast = contrast_of(coloured(128, static_cast<std::uint8_t>(v)));
    EXPECT_LE((v - 128) * contrast / kContrastOne, 112) << v;
    EXPECT_GT((v - 128) * (contrast + 4) / kContrastOne, 108) << v << ": as much as there is room for";
    EXPECT_EQ(contrast % 2, 0);
  }
  EXPECT_EQ(contrast_of(coloured(0, 128)), kContrastOne);
}

TEST(ChromaContrast, LipsCountAndAFewSamplesDoNot) {
  Picture lips = coloured(128, 140), speck = lips;
  for (int y = 22; y < 24; ++y) std::fill_n(lips.v.row(y) + 18, 6, 210);  // 0.4 % of the samples
  std::fill_n(speck.v.row(22) + 18, 3, 210);
  EXPECT_LT(contrast_of(lips), kMost);
  EXPECT_EQ(contrast_of(speck), kMost);
}

TEST(ChromaContrast, LargePicturesAreSampled) {
  Picture wide(4096, 64);
  std::fill(wide.v.samples.begin(), wide.v.samples.end(), 228);
  EXPECT_LT(contrast_of(wide), kMost);
}

}  // namespace
}  // namespace fbs
