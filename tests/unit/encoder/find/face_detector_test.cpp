#include "encoder/find/face_detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

const FaceDetector& detector() {
  static const Result<FaceDetector> d = FaceDetector::create();
  EXPECT_TRUE(d) << d.error().text;
  return *d;
}

FacePlace truth(const TalkerClip& clip) {
  return place_of(clip.shape(0));
}

/// Near enough for landmarks to be searched there.
bool is_near(const FacePlace& found, const FacePlace& wanted) {
  const glm::dvec2 d = found.centre - wanted.centre;
  return std::hypot(d.x, d.y) < 0.3 * wanted.eye_distance_px &&
         std::abs(std::log(found.eye_distance_px / wanted.eye_distance_px)) < 0.3;
}

bool has_near(const std::vector<FacePlace>& found, const FacePlace& wanted) {
  return std::ranges::any_of(found, [&](const FacePlace& f) { return is_near(f, wanted); });
}

TEST(FaceDetector, FindsTheTalkerAtEverySize) {
  for (const auto& [w, h] : {std::pair{64, 64}, {67, 65}, {176, 144}, {352, 288}}) {
    TalkerClip clip(talker_settings(w, h, 1));
    EXPECT_TRUE(has_near(detector().likely(clip[0]), truth(clip))) << w;
    EXPECT_TRUE(has_near(detector().possible(clip[0]), truth(clip))) << w;
  }
}

TEST(FaceDetector, FindsAFaceThatFillsThePicture) {
  auto settings = talker_settings(200, 200, 1);
  settings.eye_distance = 0.42F;
  TalkerClip clip(settings);
  EXPECT_TRUE(has_near(detector().likely(clip[0]), truth(clip)));
}

// While a face is lost its size is about known, which makes looking for it cheap.
TEST(FaceDetector, FindsOnlyFacesOfTheSizeAskedFor) {
  TalkerClip clip(talker_settings(352, 288, 1));
  const double eye = clip.pose(0).eye_distance_px();
  const auto faces = detector().of_size(clip[0], 0.7 * eye, 1.4 * eye);
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_TRUE(is_near(faces[0], truth(clip)));
  EXPECT_TRUE(detector().of_size(clip[0], 2 * eye, 3 * eye).empty());
}

TEST(FaceDetector, MissingCascadesAreAnIoError) {
  setenv("FBS_CASCADES", "/nowhere", 1);
  const auto missing = FaceDetector::create();
  unsetenv("FBS_CASCADES");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace fbs
