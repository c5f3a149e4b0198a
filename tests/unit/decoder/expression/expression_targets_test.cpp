#include "decoder/expression/expression_targets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "decoder/head/head_deformation.h"
#include "tests/unit/decoder/export/recorded_talk.h"

namespace fbs {
namespace {

/// Weights by name.
double weight(const ExpressionTargets& shapes, const State& state, const std::string& name) {
  const auto weights = shapes.weights(state);
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (shapes.targets()[i].name == name) return weights[i];
  ADD_FAILURE() << "no shape " << name;
  return 0;
}

/// The state in which one shape has a weight of one.
State at(const ExpressionTargets& shapes, const std::string& name) {
  State state = toy_state();
  for (const ExpressionTarget& t : shapes.targets())
    if (t.name == name)
      for (std::size_t c = 0; c < kControlCount; ++c)
        state.control[c] = {std::lround(t.offsets[c].x), std::lround(t.offsets[c].y)};
  return state;
}

double y_of(const std::vector<glm::ivec3>& vertices, std::size_t landmark) {
  return vertices[vertex_of_landmark(landmark)].y;
}

TEST(ExpressionTargets, GiveTheControlPointsExactly) {
  const ExpressionTargets shapes(toy_geometry());
  for (unsigned seed = 0; seed < 20; ++seed) {
    const State state = grimace(seed);
    const auto weights = shapes.weights(state);
    ASSERT_EQ(weights.size(), shapes.targets().size());
    ControlOffsets sum{};
    for (std::size_t i = 0; i < weights.size(); ++i)
      for (std::size_t c = 0; c < kControlCount; ++c) sum[c] += weights[i] * shapes.targets()[i].offsets[c];
    for (std::size_t c = 0; c < kControlCount; ++c) {
      EXPECT_NEAR(sum[c].x, state.control[c].x, 1e-6) << "control point " << c;
      EXPECT_NEAR(sum[c].y, state.control[c].y, 1e-6) << "control point " << c;
    }
  }
}

TEST(ExpressionTargets, AreAtRestInTheAdaptedFace) {
  for (const double w : ExpressionTargets(toy_geometry()).weights(toy_state())) EXPECT_EQ(w, 0);
}

TEST(ExpressionTargets, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  const ExpressionTargets shapes(toy_geometry());
  for (const ExpressionTarget& t : shapes.targets()) EXPECT_TRUE(names.insert(t.name).second) << t.name;
  for (std::size_t i = 0; i < shapes.targets().size(); ++i)
    EXPECT_EQ(shapes.targets()[i].detail, i >= shapes.named_count());
}

TEST(ExpressionTargets, FindEachMovementAgain) {
  const ExpressionTargets shapes(toy_geometry());
  for (std::size_t i = 0; i < shapes.named_count(); ++i) {
    // One inner end down and the other up is rather a brow that goes down.
    if (shapes.targets()[i].name == "browInnerUpAsymmetry") continue;
    const auto weights = shapes.weights(at(shapes, shapes.targets()[i].name));
    for (std::size_t j = 0; j < shapes.named_count(); ++j)
      EXPECT_NEAR(weights[j], i == j ? 1 : 0, 0.02)
          << shapes.targets()[i].name << " seen as " << shapes.targets()[j].name;
  }
}

TEST(ExpressionTargets, WithAnOppositeAreNeverNegative) {
  const ExpressionTargets shapes(toy_geometry());
  const std::set<std::string> signed_shapes{"jawOpen",          "mouthUpperUpRight",
                                            "mouthUpperUpLeft", "browInnerUpAsymmetry",
                                            "eyeSquintRight",   "eyeSquintLeft"};
  for (unsigned seed = 0; seed < 50; ++seed) {
    const auto weights = shapes.weights(grimace(seed));
    for (std::size_t i = 0; i < shapes.named_count(); ++i)
      if (!signed_shapes.contains(shapes.targets()[i].name)) {
        EXPECT_GE(weights[i], 0) << shapes.targets()[i].name;
      }
  }
}

TEST(ExpressionTargets, BlinkClosesTheEye) {
  const Geometry head = toy_geometry();
  const auto open = deform(head, toy_state());
  const auto shut = deform(head, at(ExpressionTargets(head), "eyeBlinkRight"));
  const auto opening = [](const auto& v) { return y_of(v, 40) + y_of(v, 41) - y_of(v, 37) - y_of(v, 38); };
  EXPECT_GT(opening(open), 500);
  EXPECT_NEAR(opening(shut), 0, 8);
  EXPECT_EQ(y_of(shut, 43), y_of(open, 43));  // the left eye
}

TEST(ExpressionTargets, JawOpensByTheGapBetweenTheInnerLips) {
  const Geometry head = toy_geometry();
  const auto shut = deform(head, toy_state());
  const auto open = deform(head, at(ExpressionTargets(head), "jawOpen"));
  const double gap = y_of(open, 66) - y_of(open, 62) - (y_of(shut, 66) - y_of(shut, 62));
  EXPECT_NEAR(gap / kUnitsPerEyeDistance, 0.6, 0.06);
  EXPECT_GT(y_of(open, 8) - y_of(shut, 8), 0.2 * kUnitsPerEyeDistance);  // the chin goes with it
}

TEST(ExpressionTargets, LeftIsTheSubjectsLeft) {
  const Geometry head = toy_geometry();
  const ExpressionTargets shapes(head);
  const auto rest = deform(head, toy_state());
  const auto smile = deform(head, at(shapes, "mouthSmileLeft"));
  EXPECT_GT(smile[vertex_of_landmark(54)].x, rest[vertex_of_landmark(54)].x);  // right in the picture
  EXPECT_LT(smile[vertex_of_landmark(54)].y, rest[vertex_of_landmark(54)].y);
  State looks = toy_state();
  for (const FeatureId pupil : {FeatureId::kPupilRight, FeatureId::kPupilLeft})
    looks.control[feature(pupil).first_control].x = 200;
  EXPECT_GT(weight(shapes, looks, "eyeLookOutLeft"), 0);
  EXPECT_GT(weight(shapes, looks, "eyeLookInRight"), 0);
  EXPECT_EQ(weight(shapes, looks, "eyeLookOutRight"), 0);
}

}  // namespace
}  // namespace fbs
