#include "encoder/find/face_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

const FaceFinder& finder() {
  static const Result<FaceFinder> f = FaceFinder::create();
  EXPECT_TRUE(f) << f.error().text;
  return *f;
}

double distance(glm::dvec2 a, glm::dvec2 b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

// Design, section 12: eye centres within 2-8 % of the eye distance on the clips; the talker may add a little.
TEST(FaceFinder, FindsTheTalkersEyesAtEverySize) {
  for (const auto& [w, h] : {std::pair{64, 64}, {67, 65}, {176, 144}, {352, 288}}) {
    TalkerClip clip(talker_settings(w, h, 1));
    const auto faces = finder().find(clip[0]);
    ASSERT_EQ(faces.size(), 1u) << w;
    const auto eyes = clip.marks(0).eyes();
    const double tolerance = 0.1 * clip.pose(0).eye_distance_px();
    EXPECT_TRUE(faces[0].eyes_seen);
    EXPECT_LT(distance(faces[0].right_eye, (*eyes)[0]), tolerance) << w;
    EXPECT_LT(distance(faces[0].left_eye, (*eyes)[1]), tolerance) << w;
  }
}

TEST(FaceFinder, FindsTheTalkerInManyPoses) {
  TalkerClip clip(talker_settings(176, 144, 120));
  int found = 0;
  for (int i = 0; i < 120; i += 12) found += finder().find(clip[i]).size() == 1 ? 1 : 0;
  EXPECT_GE(found, 9) << "of 10";
}

// While a face is lost its size is about known, which makes looking for it cheap.
TEST(FaceFinder, FindsOnlyFacesOfTheSizeAskedFor) {
  TalkerClip clip(talker_settings(352, 288, 1));
  const double eye = clip.pose(0).eye_distance_px();
  const auto faces = finder().find_of_size(clip[0], 0.7 * eye, 1.4 * eye);
  ASSERT_EQ(faces.size(), 1u);
  const auto eyes = clip.marks(0).eyes();
  EXPECT_LT(distance(faces[0].right_eye, (*eyes)[0]), 0.3 * eye);
  EXPECT_LT(distance(faces[0].left_eye, (*eyes)[1]), 0.3 * eye);
  EXPECT_TRUE(finder().find_of_size(clip[0], 2 * eye, 3 * eye).empty());
}

TEST(FaceFinder, SortsFacesBySize) {
  auto settings = talker_settings(176, 144, 1);
  TalkerClip small(settings);
  settings.eye_distance = 0.2F;
  TalkerClip large(settings);
  Picture both(352, 144);
  for (int y = 0; y < 144; ++y) {
    std::copy_n(small[0].y.row(y), 176, both.y.row(y));
    std::copy_n(large[0].y.row(y), 176, both.y.row(y) + 176);
  }
  const auto faces = finder().find(both);
  ASSERT_EQ(faces.size(), 2u);
  EXPECT_GT(faces[0].centre.x, 176);
  EXPECT_LT(faces[1].centre.x, 176);
  EXPECT_GT(faces[0].size, faces[1].size);
}

TEST(FaceFinder, FindsNothingWhereNobodyIs) {
  EXPECT_TRUE(finder().find(Picture(160, 120)).empty());
  std::mt19937 random(1);
  Picture noise(160, 120);
  for (auto& s : noise.y.samples) s = static_cast<std::uint8_t>(random());
  EXPECT_TRUE(finder().find(noise).empty());
}

TEST(FaceFinder, MissingCascadesAreAnIoError) {
  setenv("FBS_CASCADES", "/nowhere", 1);
  const auto missing = FaceFinder::create();
  unsetenv("FBS_CASCADES");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace fbs
