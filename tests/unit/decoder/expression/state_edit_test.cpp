#include "decoder/expression/state_edit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using Vertices = std::vector<glm::ivec3>;

constexpr std::array kParts = {EditPart::kYaw,   EditPart::kPitch, EditPart::kRoll, EditPart::kBrows,
                               EditPart::kMouth, EditPart::kSmile, EditPart::kLids};
static_assert(kParts.size() == kEditPartCount);

Vertices head_of(const State& state) {
  return deform(toy_geometry(), state);
}

Vertices edited(EditPart part, int steps, const State& state = {}) {
  StateEdit edit;
  edit.step(part, steps);
  return head_of(edit.applied(state, toy_geometry()));
}

int y(const Vertices& vertices, std::size_t mark) {
  return vertices[vertex_of_landmark(mark)].y;
}

constexpr int kFar = 1000;  // steps, beyond every limit

TEST(StateEdit, ChangesNothingAtFirst) {
  State state;
  state.blend.fill(BlendMode::kStillBefore);
  state.pose[kYaw] = 7;
  EXPECT_EQ(StateEdit().applied(state, toy_geometry()), state);
}

TEST(StateEdit, ResetTakesEverythingBack) {
  StateEdit edit;
  for (const EditPart part : kParts) edit.step(part, 1);
  EXPECT_TRUE(edit.any());
  edit.reset();
  EXPECT_FALSE(edit.any());
  EXPECT_EQ(edit.applied({}, toy_geometry()), State{});
}

TEST(StateEdit, StopsAtItsLimits) {
  for (const EditPart part : kParts) {
    StateEdit edit;
    edit.step(part, kFar);
    EXPECT_EQ(edit.value(part), StateEdit::limits(part).high);
    edit.step(part, -2 * kFar);
    EXPECT_EQ(edit.value(part), StateEdit::limits(part).low);
  }
}

TEST(StateEdit, EveryStateIsLegal) {
  State extreme;
  extreme.pose.fill(kMaxRotation);
  extreme.control.fill({kMaxControl, -kMaxControl});
  for (const int steps : {-kFar, kFar})
    for (const EditPart part : kParts) {
      StateEdit edit;
      edit.step(part, steps);
      const State out = edit.applied(extreme, toy_geometry());
      for (const int angle : {kPitch, kYaw, kRoll}) EXPECT_LE(std::abs(out.pose[angle]), kMaxRotation);
      for (const glm::ivec2 c : out.control) {
        EXPECT_LE(std::abs(c.x), kMaxControl);
        EXPECT_LE(std::abs(c.y), kMaxControl);
      }
    }
}

TEST(StateEdit, TurnsAreAddedToThePose) {
  State state;
  state.pose[kYaw] = 100;
  StateEdit edit;
  edit.add(EditPart::kYaw, 30);
  edit.add(EditPart::kRoll, -50);
  const State out = edit.applied(state, toy_geometry());
  EXPECT_EQ(out.pose[kYaw], 130);
  EXPECT_EQ(out.pose[kRoll], -50);
  EXPECT_EQ(out.control, state.control);
}

TEST(StateEdit, MouthOpensMoreWithEveryStepAndKeepsItsLips) {
  int before = mouth_gap(generic_head(), head_of({}));
  const int thickness = y(head_of({}), 57) - y(head_of({}), 66);
  for (int steps = 1; steps <= 8; ++steps) {
    const Vertices head = edited(EditPart::kMouth, steps);
    EXPECT_GT(mouth_gap(generic_head(), head), before) << steps;
    before = mouth_gap(generic_head(), head);
    EXPECT_NEAR(y(head, 57) - y(head, 66), thickness, 100) << "lower lip";
  }
}

TEST(StateEdit, MouthThatIsOpenAlreadyOpensNoFartherThanTheLimit) {
  const int widest = mouth_gap(generic_head(), edited(EditPart::kMouth, kFar));
  StateEdit half;
  half.step(EditPart::kMouth, 5);
  const State open = half.applied({}, toy_geometry());
  EXPECT_NEAR(mouth_gap(generic_head(), edited(EditPart::kMouth, kFar, open)), widest, widest / 5);
}

TEST(StateEdit, MouthIsShutAndNoMore) {
  StateEdit half;
  half.step(EditPart::kMouth, 5);
  const State open = half.applied({}, toy_geometry());
  const int gap = mouth_gap(generic_head(), edited(EditPart::kMouth, -kFar, open));
  EXPECT_LT(gap, mouth_gap(generic_head(), head_of(open)) / 2);
  EXPECT_GE(gap, mouth_gap(generic_head(), head_of({})) - 200);
}

TEST(StateEdit, LidsMeetAndDoNotCross) {
  const Vertices open = head_of({}), shut = edited(EditPart::kLids, kFar);
  for (const auto& [upper, lower] : {std::pair{37, 41}, {38, 40}, {43, 47}, {44, 46}}) {
    const auto gap = [&](const Vertices& v) {
      return y(v, static_cast<std::size_t>(lower)) - y(v, static_cast<std::size_t>(upper));
    };
    EXPECT_GE(gap(shut), -2);
    EXPECT_LE(gap(shut), gap(open) / 4);
    EXPECT_GT(gap(edited(EditPart::kLids, -kFar)), gap(open));
  }
}

TEST(StateEdit, BrowsRiseAndTheMouthStays) {
  const Vertices neutral = head_of({}), raised = edited(EditPart::kBrows, 2);
  for (std::size_t mark = 17; mark <= 26; ++mark) EXPECT_LT(y(raised, mark), y(neutral, mark)) << mark;
  for (std::size_t mark = 48; mark < 68; ++mark) EXPECT_EQ(y(raised, mark), y(neutral, mark)) << mark;
}

TEST(StateEdit, SmileTakesTheCornersOutAndUp) {
  const Vertices neutral = head_of({}), smile = edited(EditPart::kSmile, 2);
  const auto x = [](const Vertices& v, std::size_t mark) { return v[vertex_of_landmark(mark)].x; };
  EXPECT_LT(x(smile, 48), x(neutral, 48));
  EXPECT_GT(x(smile, 54), x(neutral, 54));
  EXPECT_LT(y(smile, 48), y(neutral, 48));
  EXPECT_LT(y(smile, 54), y(neutral, 54));
}

TEST(StateEdit, HeadThatIsShownStillIsWarpedAndTheGroundIsNot) {
  State state;
  state.blend.fill(BlendMode::kStillBefore);
  StateEdit edit;
  edit.step(EditPart::kMouth, 1);
  const State out = edit.applied(state, toy_geometry());
  EXPECT_EQ(out.blend[static_cast<std::size_t>(Region::kMouth)], BlendMode::kByState);
  EXPECT_EQ(out.blend[static_cast<std::size_t>(Region::kHair)], BlendMode::kByState);
  EXPECT_EQ(out.blend[static_cast<std::size_t>(Region::kGround)], BlendMode::kStillBefore);
}

}  // namespace
}  // namespace fbs
