#include "encoder/fit/gaze_search.h"

#include <gtest/gtest.h>

#include "tests/unit/encoder/fit/fitted_scene.h"

namespace fbs {
namespace {

constexpr std::array kPupils = {FeatureId::kPupilRight, FeatureId::kPupilLeft};

State looking(State state, double x) {
  for (const FeatureId pupil : kPupils)
    state.control[feature(pupil).first_control].x = static_cast<std::int32_t>(x * kUnitsPerEyeDistance);
  return state;
}

// Eyes jump from one side to the other between two pictures.
TEST(GazeSearch, FindsEyesThatLookElsewhere) {
  FittedScene s;
  for (const double truth : {-0.2, 0.0, 0.2}) {
    s.set_picture(looking(s.seen, truth));
    const Fit found = s.fit.with_best_eyes(fit_of(looking(s.seen, truth > 0 ? -0.24 : 0.24)));
    for (const FeatureId pupil : kPupils)
      EXPECT_NEAR(found.offsets[feature(pupil).first_control].x, truth * kUnitsPerEyeDistance,
                  0.09 * kUnitsPerEyeDistance)
          << truth;
  }
}

TEST(GazeSearch, LeavesEyesThatLookThereAlready) {
  FittedScene s;
  const State truth = looking(s.seen, 0.05);
  s.set_picture(truth);
  const Fit found = s.fit.with_best_eyes(fit_of(truth));
  for (const FeatureId pupil : kPupils)
    EXPECT_EQ(found.offsets[feature(pupil).first_control],
              fit_of(truth).offsets[feature(pupil).first_control]);
}

TEST(GazeSearch, LeavesPupilsThatAreNotSent) {
  FittedScene s;
  fbs::Setup without = s.setup;
  without.parts = static_cast<PartMask>(kAllParts & ~mask_of(PartId::kGaze) & ~mask_of(PartId::kUpperLids));
  const WorkFrame frame = WorkFrame::cut(s.scene.patterns[0].picture, {160, 96}, 48, true);
  PictureFit fit(without, toy_geometry(), {frame, s.seen});
  fit.set_picture(frame);
  const Fit start = fit_of(looking(s.seen, 0.24));
  EXPECT_EQ(fit.with_best_eyes(start).offsets, start.offsets);
}

}  // namespace
}  // namespace fbs
