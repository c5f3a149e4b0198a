#include "encoder/find/find_marks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

double distance(glm::dvec2 a, glm::dvec2 b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// Mean distance from the truth over landmarks [first, end), eye distances.
double error_of(const Marks& marks, const TalkerClip& clip, int first, int end) {
  const Marks truth = clip.marks(0);
  double sum = 0;
  for (int k = first; k < end; ++k) sum += distance(*marks.landmark(k), *truth.landmark(k));
  return sum / (end - first) / clip.pose(0).eye_distance_px();
}

TEST(FindMarks, LandNearTheTalkersPoints) {
  const auto finder = FaceFinder::create();
  ASSERT_TRUE(finder) << finder.error().text;
  for (const unsigned seed : {1U, 2U, 3U}) {
    auto settings = talker_settings(264, 216, 1);
    settings.seed = seed;
    TalkerClip clip(settings);
    const auto faces = finder->find(clip[0]);
    ASSERT_FALSE(faces.empty());
    const Marks marks = find_marks(clip[0], faces[0]);
    for (int k = 0; k < kLandmarkCount; ++k) ASSERT_TRUE(marks.landmark(k)) << k;
    EXPECT_LT(error_of(marks, clip, 0, 17), 0.14) << "jaw, seed " << seed;
    EXPECT_LT(error_of(marks, clip, 17, 27), 0.06) << "brows, seed " << seed;
    EXPECT_LT(error_of(marks, clip, 27, 36), 0.05) << "nose, seed " << seed;
    EXPECT_LT(error_of(marks, clip, 36, 48), 0.04) << "eyes, seed " << seed;
    EXPECT_LT(error_of(marks, clip, 48, 68), 0.09) << "mouth, seed " << seed;
  }
}

// Where the picture says nothing the proportion is kept.
TEST(FindMarks, FlatPictureKeepsTheProportionsOfTheGenericHead) {
  FoundFace face;
  face.right_eye = {80, 60};
  face.left_eye = {120, 60};
  face.centre = {100, 70};
  face.size = 100;
  Picture flat(200, 160);
  const Marks marks = find_marks(flat, face);
  for (int k = 0; k < kLandmarkCount; ++k) {
    ASSERT_TRUE(marks.landmark(k)) << k;
    const auto v = vertex_of_landmark(k);
    const glm::ivec3 p = generic_head().vertices[v].position;
    EXPECT_LT(distance(*marks.landmark(k), glm::dvec2(100, 60) + glm::dvec2(p.x, p.y) * (40.0 / 4096)), 8)
        << k;
  }
}

// The search reaches beyond a face that is cut off.
TEST(FindMarks, FaceAtThePicturesBorderIsHarmless) {
  FoundFace face;
  face.right_eye = {-10, 2};
  face.left_eye = {15, -4};
  face.centre = {3, 10};
  face.size = 60;
  const Marks marks = find_marks(Picture(64, 64), face);
  for (int k = 0; k < kLandmarkCount; ++k)
    EXPECT_TRUE(std::isfinite(marks.landmark(k)->x) && std::isfinite(marks.landmark(k)->y));
}

}  // namespace
}  // namespace fbs
