#include "encoder/segment/pass_settings.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fbs {
namespace {

constexpr double kEye = 48;

VideoFormat format(int width = 352, int height = 288) {
  VideoFormat out;
  out.width = width;
  out.height = height;
  out.frame_rate = {25, 1};
  return out;
}

EncoderSettings live() {
  EncoderSettings out;
  out.live.emplace();
  return out;
}

const OperatingPoint kMotion = OperatingPoint::at(50, kEye);

TEST(MotionTarget, OnePatternLeavesTheRateToTheMotion) {
  EncoderSettings settings;
  settings.patterns = 1;
  settings.bitrate = 8;
  EXPECT_EQ(motion_target(settings, kEye).bitrate_kbps, 8);
}

TEST(MotionTarget, SeveralPatternsTakeWhatTheMotionLeaves) {
  EncoderSettings settings;
  EXPECT_EQ(motion_target(settings, kEye).quality, PatternPoint::at(50).motion_quality);
  settings.bitrate = 8;
  const RateTarget target = motion_target(settings, kEye);
  EXPECT_EQ(target.bitrate_kbps, 0);
  EXPECT_EQ(target.quality, motion_quality_at(8, false));
}

TEST(PassSettings, PsnrKeepsContrastAndCoarserPatterns) {
  EncoderSettings settings;
  settings.tune = Tune::kPsnr;
  const FilePatternSettings pass = pass_settings(settings, kMotion);
  EXPECT_EQ(pass.point.quantiser, PatternPoint::at(50).quantiser);
  EXPECT_EQ(pass.point_at(70).quantiser, PatternPoint::at(70).quantiser);
  EXPECT_GT(pass.point.quantiser, PatternPoint::by_eye(50).quantiser);
  EXPECT_GT(surround_contrast(Tune::kPsnr), surround_contrast(Tune::kEye));
  EXPECT_EQ(planar_pass_settings({}, kMotion).point.quantiser, PatternPoint::without_face(50).quantiser);
}

TEST(PassSettings, QualityDecidesWhatIsNotAskedFor) {
  const FilePatternSettings pass = pass_settings({}, kMotion);
  EXPECT_EQ(pass.point.quantiser, PatternPoint::by_eye(50).quantiser);
  EXPECT_EQ(pass.lone_quantiser, kMotion.pattern_quantiser);
  EXPECT_EQ(pass.lambda, kMotion.lambda);
  EXPECT_FALSE(pass.quantiser);
  EXPECT_FALSE(pass.reduced);
  EXPECT_FALSE(pass.without_face);
}

TEST(PassSettings, AQuantiserThatIsAskedForHoldsForALonePatternToo) {
  EncoderSettings settings;
  settings.pattern_quantiser = 33;
  const FilePatternSettings pass = pass_settings(settings, kMotion);
  EXPECT_EQ(pass.quantiser, 33);
  EXPECT_EQ(pass.lone_quantiser, 33);
}

TEST(PassSettings, EffortSolvesAndFits) {
  EncoderSettings settings;
  for (int effort = 0; effort <= Effort::kMost; ++effort) {
    settings.effort = effort;
    EXPECT_EQ(pass_settings(settings, kMotion).effort.solves, Effort::of(effort).solves);
    EXPECT_EQ(pass_settings(settings, kMotion).effort.refits, Effort::of(effort).refits);
  }
  settings.track_only = true;
  EXPECT_EQ(pass_settings(settings, kMotion).effort.refits, 0) << "nothing is fitted to what is shown";
}

TEST(PassSettings, AShotWithoutAFaceHasMorePatternsAndNothingToFit) {
  const FilePatternSettings pass = planar_pass_settings({}, kMotion);
  EXPECT_TRUE(pass.without_face);
  EXPECT_EQ(pass.effort.refits, 0);
  EXPECT_EQ(pass.point.per_second, PatternPoint::without_face(50).per_second);
  EXPECT_EQ(pass.point_at(70).quantiser, PatternPoint::without_face(70).quantiser);
}

TEST(PassSettings, FilesStartInASecondOnlyIfAskedTo) {
  EncoderSettings settings;
  settings.bitrate = 5;
  EXPECT_EQ(pass_settings(settings, kMotion).start, 0);
  settings.start = 2;
  EXPECT_EQ(pass_settings(settings, kMotion).start, 2);
}

TEST(PassSettings, OnlyALiveStageEndsASegmentWithEachGroup) {
  for (const auto& pass_of : {&pass_settings, &planar_pass_settings}) {
    const auto make = [&](const EncoderSettings& settings) {
      return pattern_stage(pass_of(settings, kMotion), settings, format(), {});
    };
    EXPECT_TRUE(make(live())->segment_ends(5));
    EXPECT_FALSE(make({})->segment_ends(5));
    EXPECT_EQ(make(live())->slots(), pattern_store(format()));
    EncoderSettings late = live();
    late.live->delay = 1;
    EXPECT_FALSE(make(late)->segment_ends(5));
  }
}

}  // namespace
}  // namespace fbs
