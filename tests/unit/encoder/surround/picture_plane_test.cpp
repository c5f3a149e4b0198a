#include "encoder/surround/picture_plane.h"

#include <gtest/gtest.h>

#include "common/quality.h"
#include "decoder/draw/renderer.h"
#include "decoder/scene/scene_face.h"
#include "encoder/model/coded_numbers.h"
#include "encoder/surround/map_grid.h"
#include "tests/unit/encoder/moving_pictures.h"

namespace fbs {
namespace {

constexpr int kWidth = 176, kHeight = 144;

PicturePlane plane() {
  auto made = PicturePlane::create(format_of(kWidth, kHeight));
  EXPECT_TRUE(made);
  return std::move(*made);
}

State state_at(const PicturePlane& plane, const PlaneMotion& motion, const Setup& setup) {
  return state_of(coded_state(numbers_of(plane.pose(motion)), setup), setup.steps);
}

TEST(PicturePlane, IsSmallAndNoFace) {
  EXPECT_LT(plane().payload().size(), 40U);
  EXPECT_TRUE(is_flat(plane().geometry()));
  EXPECT_TRUE(is_flat(no_plane()));
  Geometry head;
  for (std::size_t v = 0; v < kVertexCount; ++v) head.positions[v] = generic_head().vertices[v].position;
  EXPECT_FALSE(is_flat(head));
}

// Once the camera has moved, all that a pattern shows is where the camera sees it: beyond the borders of the
// rest state, too.
TEST(PicturePlane, DrawsAPatternWhereTheCameraSeesIt) {
  const PicturePlane p = plane();
  fbs::Setup setup;
  setup.format = format_of(kWidth, kHeight);
  setup.steps = p.steps(1.0 / 64);
  const State rest = state_at(p, {}, setup);
  const PlaneMotion far{1, {-900, 250}}, near = far.then({std::polar(1.03, 0.02), {-6, 4}});
  Scene scene;
  scene.setup = setup;
  scene.geometry.emplace(setup, p.geometry(), uniform_map({1, 1}, {}), rest);
  scene.patterns.push_back(
      make_pattern(seen_wall(kWidth, kHeight, far.turn, far.shift), state_at(p, far, setup), scene.geometry));
  Picture drawn;
  ASSERT_TRUE(Renderer().render(scene, state_at(p, near, setup), drawn));
  const Picture expected = seen_wall(kWidth, kHeight, near.turn, near.shift);
  SquaredError inside;
  for (int y = 24; y < kHeight - 24; ++y)
    for (int x = 24; x < kWidth - 24; ++x) inside.add(drawn.y.row(y)[x], expected.y.row(y)[x]);
  EXPECT_GT(inside.psnr(), 38);
}

TEST(PicturePlane, EndsSomewhere) {
  EXPECT_TRUE(plane().covers({}));
  EXPECT_TRUE(plane().covers({1, {3.0 * kWidth, 0}}));
  EXPECT_FALSE(plane().covers({1, {30.0 * kWidth, 0}}));
  EXPECT_TRUE(plane().covers({0.5, 0}));
  EXPECT_FALSE(plane().covers({0.01, 0}));
}

TEST(PicturePlane, CostIsThatOfDisplacedSlopes) {
  GlobalMotion::Observation seen;
  seen.places.push_back({{30, 40}, {4, 0, 0}});  // slopes to the right only
  const auto q = PicturePlane::quadratic(seen);
  constexpr double kPixel = kStateUnitsPerPixel;
  EXPECT_NEAR(q(kShiftX, kShiftX) * kPixel * kPixel, 4, 1e-9);
  EXPECT_NEAR(q(kShiftY, kShiftY), 0, 1e-12);
  const double octave = 4096;
  EXPECT_NEAR(q(kLogScale, kLogScale) * octave * octave, 4 * std::pow(30 * std::log(2.0), 2), 1e-6);
  const double turn = 65536 / (2 * std::numbers::pi);
  EXPECT_NEAR(q(kRoll, kRoll) * turn * turn, 4 * 40 * 40, 1e-6);
  EXPECT_EQ(q(kPitch, kPitch), 0);
}

}  // namespace
}  // namespace fbs
