#include "encoder/segment/segment_blend.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/blend/blended_scene.h"

namespace fbs {
namespace {

constexpr std::size_t kPatterns = 3, kGroup = 7, kPictures = 21;

/// Pictures of a scene that is drawn by the renderer, in one mode throughout.
struct DrawnSegment {
  BlendedScene s;
  Segment segment;

  explicit DrawnSegment(BlendMode mode, int width = BlendedScene::kWidth, int height = BlendedScene::kHeight)
      : s(kPatterns, 4, width, height) {
    for (std::size_t t = 0; t < kPictures; ++t) {
      State state = SeenScene::rest();
      StateMaker maker(static_cast<unsigned>(t));
      maker.pose(state);
      // Patterns are pictures of the segment as well.
      if (t % BlendedScene::kSpacing == 0) state = s.scene.patterns[t / BlendedScene::kSpacing].seen;
      state.picture = static_cast<std::int32_t>(t);
      state = with_mode(state, mode);
      EXPECT_TRUE(segment.pictures.add(rendered(s.scene, state)));
      segment.states.push_back(state);
    }
    for (std::size_t t = 0; t < kPictures; t += kGroup) segment.groups.push_back({kGroup, {}});
  }
  [[nodiscard]] SegmentPatterns patterns() const {
    return {s.blend(), std::vector<AvailablePatterns>(segment.groups.size(), s.all())};
  }
};

TEST(SegmentBlend, FindsTheModesThatPicturesAreDrawnIn) {
  Workers workers(2);
  for (const BlendMode mode : {BlendMode::kByTime, nearest(1)}) {
    DrawnSegment d(mode);
    const auto errors = mode_errors(d.segment, d.patterns(), 1, workers);
    ASSERT_TRUE(errors);
    const auto modes = errors->cheapest_modes(100);
    ASSERT_EQ(modes.size(), kPictures);
    std::size_t found = 0;
    for (const RegionModes& m : modes) found += m[static_cast<std::size_t>(Region::kFace)] == mode ? 1 : 0;
    EXPECT_GE(found, kPictures - 2) << static_cast<int>(mode);
  }
}

// The nearest pattern, in count, may be another after a cut.
TEST(SegmentBlend, ModesAreNotSharedAcrossACut) {
  Workers workers(2);
  constexpr std::size_t kCut = 10, kShared = 3;  // 9, 10 and 11 would share their modes
  DrawnSegment before(BlendMode::kByTime), after(nearest(1));
  Segment segment;
  for (std::size_t t = 0; t < kPictures; ++t) {
    State state = (t < kCut ? before : after).segment.states[t];
    if (t >= kCut) state.light[kLightOffset] += 40 * 16;
    ASSERT_TRUE(segment.pictures.add(rendered(before.s.scene, state)));
    segment.states.push_back(state);
  }
  segment.groups = before.segment.groups;
  segment.shots = {{kCut, false}, {kPictures - kCut, false}};
  const auto errors = mode_errors(segment, before.patterns(), kShared, workers);
  ASSERT_TRUE(errors);
  const auto modes = errors->cheapest_modes(1);
  ASSERT_EQ(modes.size(), kPictures);
  const auto of_face = [&](std::size_t t) { return modes[t][static_cast<std::size_t>(Region::kFace)]; };
  EXPECT_EQ(of_face(kCut - 1), BlendMode::kByTime);
  EXPECT_EQ(of_face(kCut), nearest(1));
}

/// Replaces the picture of a pattern.
void show(Scene& scene, std::size_t k, const Picture& picture) {
  Pattern pattern = scene.patterns[k];
  pattern.picture = picture;
  scene.patterns.replace(k, std::move(pattern));
}

TEST(SegmentBlend, LossIsSmallBetweenTheTruePatternsAndLargeBetweenOthers) {
  Workers workers(2);
  DrawnSegment d(BlendMode::kByState);
  const auto loss = blend_loss(d.segment, d.patterns(), 5, workers);
  ASSERT_TRUE(loss);
  EXPECT_LT(*loss, 2);
  Picture other = d.s.scene.patterns.front().picture;
  other.y = wave_plane(BlendedScene::kWidth, BlendedScene::kHeight, 99);
  for (std::size_t k = 0; k < kPatterns; ++k) show(d.s.scene, k, other);
  EXPECT_GT(*blend_loss(d.segment, d.patterns(), 5, workers), 100);
}

TEST(SegmentBlend, GroupsUseWhatIsAvailableToThem) {
  Workers workers(2);
  DrawnSegment d(BlendMode::kByState);
  SegmentPatterns few = d.patterns();
  for (AvailablePatterns& available : few.available) available = {0};
  EXPECT_GT(*blend_loss(d.segment, few, 5, workers), 10 * *blend_loss(d.segment, d.patterns(), 5, workers));
}

/// Luma error of what is drawn from the patterns against clean pictures.
double loss_of(DrawnSegment& d, std::span<const Picture> clean, std::span<const Picture> patterns) {
  for (std::size_t k = 0; k < kPatterns; ++k) show(d.s.scene, k, patterns[k]);
  double sum = 0;
  for (std::size_t t = 0; t < kPictures; ++t)
    sum += squares(rendered(d.s.scene, d.segment.states[t]), clean[t]);
  return sum;
}

// What one picture alone has does not help to draw the others.
TEST(SegmentBlend, SolvedPatternsDrawTheSegmentBetterThanItsPictures) {
  Workers workers(2);
  // Solved for at full size, and at half.
  for (const auto& [width, height] : {std::pair{320, 240}, {480, 320}}) {
    DrawnSegment d(nearest(0), width, height);
    std::vector<Picture> clean, own;
    PictureSpool spoilt;
    for (std::size_t t = 0; t < kPictures; ++t) {
      Picture picture = *d.segment.pictures.read(t);
      clean.push_back(picture);
      const Plane wave = wave_plane(width, height, 500 + static_cast<unsigned>(t));
      for (std::size_t i = 0; i < wave.samples.size(); ++i)
        picture.y.samples[i] = static_cast<std::uint8_t>((3 * picture.y.samples[i] + wave.samples[i]) / 4);
      ASSERT_TRUE(spoilt.add(picture));
      if (t % BlendedScene::kSpacing == 0) own.push_back(std::move(picture));
    }
    d.segment.pictures = std::move(spoilt);
    const auto solved = solve_patterns(d.segment, d.patterns(), kPatterns, SolverSettings{}, workers);
    ASSERT_TRUE(solved);
    ASSERT_EQ(solved->size(), kPatterns);
    EXPECT_LT(loss_of(d, clean, *solved), 0.85 * loss_of(d, clean, own)) << width;
  }
}

TEST(SegmentBlend, OnlyTheLastPatternsAreSolvedFor) {
  Workers workers(2);
  DrawnSegment d(BlendMode::kByState);
  const auto solved = solve_patterns(d.segment, d.patterns(), 1, {}, workers);
  ASSERT_TRUE(solved);
  ASSERT_EQ(solved->size(), 1U);
  const auto nearness = [&](std::size_t k) { return squares((*solved)[0], d.s.scene.patterns[k].picture); };
  EXPECT_LT(nearness(2), nearness(1));
  EXPECT_LT(nearness(2), nearness(0));
}

// The largest reduction is of the width: it must leave rows.
TEST(SegmentBlend, TakesTheWidestAndLowestPictures) {
  Workers workers(2);
  BlendedScene s(2, 1, kMaxPictureSize, kMinPictureSize);
  Segment segment;
  for (const std::int32_t t : {0, 1}) {
    State state = SeenScene::rest();
    state.picture = t;
    ASSERT_TRUE(segment.pictures.add(rendered(s.scene, state)));
    segment.states.push_back(state);
  }
  Pattern second = s.scene.patterns[1];
  second.seen.picture = 1;
  s.scene.patterns.replace(1, std::move(second));
  segment.groups.push_back({2, {}});
  const SegmentPatterns patterns{s.blend(), {s.all()}};
  const auto loss = blend_loss(segment, patterns, 1, workers);
  ASSERT_TRUE(loss);
  EXPECT_LT(*loss, 10);
  EXPECT_TRUE(solve_patterns(segment, patterns, 2, {}, workers));
}

}  // namespace
}  // namespace fbs
