#include "decoder/export/head_look.h"

#include <gtest/gtest.h>

#include "decoder/head/head_deformation.h"
#include "tests/unit/decoder/export/recorded_talk.h"

namespace fbs {
namespace {

RecordedHead toy_head(const State& seen) {
  RecordedHead head{toy_geometry(), noise_picture(160, 128, 1), seen, {}, {}};
  head.states.push_back({0, seen});
  return head;
}

TEST(HeadLook, TextureHoldsTheWholeFace) {
  const RecordedHead head = toy_head(toy_state());
  const TextureArea area = texture_area(head);
  EXPECT_LT(area.width * area.height, 160 * 128 / 2);
  const auto coordinates = texture_coordinates(head, area);
  const auto vertices = project_vertices(head.geometry, head.seen);
  for (std::size_t v = 0; v < coordinates.size(); ++v) {
    EXPECT_GT(coordinates[v].x * area.width, 1);
    EXPECT_LT(coordinates[v].x * area.width, area.width - 1);
    EXPECT_GT(coordinates[v].y * area.height, 1);
    EXPECT_LT(coordinates[v].y * area.height, area.height - 1);
    EXPECT_NEAR(coordinates[v].x * area.width + area.left, vertices[v].x / 64.0, 1e-9);
    EXPECT_NEAR(coordinates[v].y * area.height + area.top, vertices[v].y / 64.0, 1e-9);
  }
}

TEST(HeadLook, TextureEndsWithThePicture) {
  for (const State& seen : {toy_state(2, 3), toy_state(158, 126), toy_state(-4000, 9000)}) {
    const TextureArea area = texture_area(toy_head(seen));
    EXPECT_GE(area.left, 0);
    EXPECT_GE(area.top, 0);
    EXPECT_GE(area.width, 1);
    EXPECT_GE(area.height, 1);
    EXPECT_LE(area.left + area.width, 160);
    EXPECT_LE(area.top + area.height, 128);
  }
}

TEST(HeadLook, MouthIsApartWhereThePatternDoesNotShowIt) {
  const std::size_t corners = 3 * generic_head().triangles.size();
  const HeadTriangles shut = head_triangles(toy_head(toy_state()));
  EXPECT_EQ(shut.mouth.size(), 3U * 6U);  // eight inner lip vertices
  EXPECT_EQ(shut.face.size() + shut.mouth.size(), corners);
  const HeadTriangles open = head_triangles(toy_head(talking(10)));
  EXPECT_TRUE(open.mouth.empty());
  EXPECT_EQ(open.face.size(), corners);
}

TEST(HeadLook, MouthHasTheLightOfPicturesInWhichItIsOpen) {
  RecordedHead head = toy_head(toy_state());
  head.mouth = {{100, 120, 140}, {40, 120, 140}};
  head.states[0].state.interior = {-900, -900, -900};  // shut: does not count
  EXPECT_EQ(mouth_colours(head)[0].y, 100);
  head.states.push_back({kToyDuration, talking(10)});
  head.states.back().state.interior = {32, 0, 16};
  const auto colours = mouth_colours(head);
  EXPECT_EQ(colours[0], (YuvColour{102, 120, 140}));
  EXPECT_EQ(colours[1], (YuvColour{70, 120, 140}));
  EXPECT_EQ(colours[2], (YuvColour{41, 120, 140}));
}

}  // namespace
}  // namespace fbs
