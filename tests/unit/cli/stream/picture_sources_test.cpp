#include "cli/stream/picture_sources.h"

#include <gtest/gtest.h>

#include "decoder/blend/picture_blend.h"
#include "tests/unit/decoder/stream/stream_writer.h"

namespace fbs::cli {
namespace {

constexpr auto kMouth = static_cast<std::size_t>(Region::kMouth),
               kGround = static_cast<std::size_t>(Region::kGround);

/// Decodes up to the picture of this number.
void decode_to(StreamDecoder& decoder, std::uint64_t picture) {
  while (decoder.pictures() <= picture) ASSERT_EQ(decoder.next(), DecodeStatus::kPicture);
}

PictureSources sources_at(const Writer& w, std::uint64_t picture) {
  StreamDecoder decoder = recording_decoder(w);
  decode_to(decoder, picture);
  return picture_sources(decoder);
}

/// Patterns of pictures 0 and 4 in slots 0 and 1, then one of picture 8 in place of the first.
Writer replacing(BlendMode mode) {
  Writer w;
  w.setup(setup_of(2)).geometry().surround().pattern();
  w.motion(0, 10, true).pattern(face_picture(1), 1, 4).blend(5, mode);
  w.pattern(face_picture(2), 0, 8).blend(5, mode);
  return w;
}

TEST(PictureSources, NumberIsThatOfThePatternInTheSlot) {
  const Writer w = replacing(BlendMode::kStillAfter);
  const PictureSources first = sources_at(w, 2), last = sources_at(w, 6);
  EXPECT_EQ(first.in_slot, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(last.in_slot, (std::vector<std::size_t>{2, 1}));
  EXPECT_EQ(first.regions[kMouth], (std::vector<PatternWeight>{{1, true, kBlendOne}}));
  EXPECT_EQ(last.regions[kMouth], (std::vector<PatternWeight>{{2, true, kBlendOne}}));
}

TEST(PictureSources, PictureAndArrivedPatternsAreCounted) {
  const Writer w = replacing(BlendMode::kByTime);
  EXPECT_EQ(sources_at(w, 0).picture, 0U);
  EXPECT_EQ(sources_at(w, 6).picture, 6U);
  EXPECT_EQ(sources_at(w, 4).arrived, 2U);
  EXPECT_EQ(sources_at(w, 5).arrived, 3U);
}

// Slot 0 has pattern 2, slot 1 pattern 1.
TEST(PictureSources, WeightsOfARegionRiseByNumberWarpedBeforeStill) {
  const PictureSources sources = sources_at(replacing(BlendMode::kHalfStill), 6);
  for (const auto& region : sources.regions) {
    ASSERT_EQ(region.size(), 4U);
    EXPECT_TRUE(region[0].number == 1 && !region[0].still && region[1].number == 1 && region[1].still);
    EXPECT_TRUE(region[2].number == 2 && !region[2].still && region[3].number == 2 && region[3].still);
    EXPECT_EQ(region[0].weight + region[1].weight + region[2].weight + region[3].weight, kBlendOne);
  }
}

TEST(PictureSources, CrossFadeFollowsTheTime) {
  const PictureSources sources = sources_at(replacing(BlendMode::kByTime), 1);
  EXPECT_EQ(sources.regions[kGround],
            (std::vector<PatternWeight>{{0, false, kBlendOne * 3 / 4}, {1, false, kBlendOne / 4}}));
}

TEST(PictureSources, WithoutAFaceAllIsStillGround) {
  Writer w;
  w.setup(setup_of(2)).pattern().motion(0, 10, true).pattern(face_picture(1), 1, 4);
  w.blend(10, BlendMode::kHalfStill);
  const PictureSources sources = sources_at(w, 1);
  for (std::size_t r = 0; r < kGround; ++r) EXPECT_TRUE(sources.regions[r].empty()) << r;
  EXPECT_EQ(sources.regions[kGround],
            (std::vector<PatternWeight>{{0, true, kBlendOne * 3 / 4}, {1, true, kBlendOne / 4}}));
}

// Slot 1 is empty: the pattern of slot 2 is the second of the scene.
TEST(PictureSources, NumbersAreRightWhereASlotIsEmpty) {
  Writer w;
  w.setup(setup_of(3)).geometry().surround().pattern();
  w.motion(0, 10, true).pattern(face_picture(1), 2, 4).blend(10, BlendMode::kStillAfter);
  EXPECT_EQ(sources_at(w, 2).regions[kMouth], (std::vector<PatternWeight>{{1, true, kBlendOne}}));
}

TEST(PictureSources, BeforeTheFirstPatternThereAreNone) {
  StreamDecoder decoder;
  decoder.record_patterns();
  const PictureSources sources = picture_sources(decoder);
  EXPECT_EQ(sources.arrived, 0U);
  EXPECT_TRUE(sources.in_slot.empty());
  for (const auto& region : sources.regions) EXPECT_TRUE(region.empty());
}

}  // namespace
}  // namespace fbs::cli
