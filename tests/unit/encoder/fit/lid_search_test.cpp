#include "encoder/fit/lid_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/encoder/fit/fitted_scene.h"

namespace fbs {
namespace {

// A blink is over in three pictures: both lids are found shut, or open again, in one step.
TEST(LidSearch, FindsLidsWhereverTheyWere) {
  FittedScene s;
  const auto lids = {FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft};
  const auto lowered = [&](double by) {
    State state = s.seen;
    for (const FeatureId id : lids)
      for (int i = 0; i < 2; ++i)
        state.control[feature(id).first_control + i] = {0, static_cast<int>(std::lround(by))};
    return state;
  };
  const double down = 0.12 * kUnitsPerEyeDistance;
  for (const double truth : {0.0, down}) {
    s.set_picture(lowered(truth));
    Fit start{pose_of(s.seen), {}, {}};
    for (const FeatureId id : lids)
      for (std::size_t i = 0; i < 2; ++i) start.offsets[feature(id).first_control + i] = {0, down - truth};
    const Fit found = s.fit.with_best_eyes(start);
    for (const FeatureId id : lids)
      EXPECT_NEAR(found.offsets[feature(id).first_control].y, truth, 0.35 * down);
  }
}

TEST(LidSearch, LeavesLidsThatAreNotSent) {
  FittedScene s;
  fbs::Setup without = s.setup;
  without.parts = static_cast<PartMask>(kAllParts & ~mask_of(PartId::kUpperLids));
  const WorkFrame frame = WorkFrame::cut(s.scene.patterns[0].picture, {160, 96}, 48, true);
  PictureFit fit(without, toy_geometry(), {frame, s.seen});
  fit.set_picture(frame);
  Fit start = fit_of(s.seen);
  start.offsets[feature(FeatureId::kUpperLidLeft).first_control] = {10, 200};
  EXPECT_EQ(fit.with_best_eyes(start).offsets, start.offsets);
}

}  // namespace
}  // namespace fbs
