#include "encoder/find/face_finder.h"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(FaceFinder, FindsTheTalkersLandmarksAtEverySize) {
  for (const auto& [w, h] : {std::pair{64, 64}, {67, 65}, {176, 144}, {352, 288}}) {
    TalkerClip clip(talker_settings(w, h, 1));
    const auto faces = finder().find(clip[0]);
    ASSERT_EQ(faces.size(), 1u) << w;
    EXPECT_GE(faces[0].landmarks.belief, FaceFinder::kBelieved);
    const Shape truth = clip.shape(0);
    double sum = 0;
    for (std::size_t k = 0; k < truth.size(); ++k)
      sum += distance(faces[0].landmarks.points[k], glm::dvec2(truth[k]));
    EXPECT_LT(sum / kLandmarkCount, (h < 100 ? 0.12 : 0.06) * faces[0].place.eye_distance_px) << w;
  }
}

TEST(FaceFinder, FindsTheTalkerInManyPoses) {
  TalkerClip clip(talker_settings(176, 144, 120));
  int found = 0;
  for (int i = 0; i < 120; i += 12) found += finder().find(clip[i]).size() == 1 ? 1 : 0;
  EXPECT_GE(found, 9) << "of 10";
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
  const auto faces = finder().find(both, 2);
  ASSERT_EQ(faces.size(), 2u);
  EXPECT_GT(faces[0].place.centre.x, 176);
  EXPECT_LT(faces[1].place.centre.x, 176);
  EXPECT_GT(faces[0].place.eye_distance_px, faces[1].place.eye_distance_px);
}

TEST(FaceFinder, WaitsForSomebodyWhoComesIn) {
  TalkerClip clip(talker_settings(352, 288, 1));
  const FacePlace face = place_of(clip.shape(0));
  const auto cut_at = [&](double x) {
    const int first = static_cast<int>(x), width = 352 - first;
    Picture out(width, 288);
    for (int y = 0; y < 288; ++y) std::copy_n(clip[0].y.row(y) + first, width, out.y.row(y));
    return out;
  };
  EXPECT_TRUE(finder().find(cut_at(face.centre.x)).empty()) << "half a face";
  EXPECT_EQ(finder().find(cut_at(face.centre.x - 1.5 * face.eye_distance_px)).size(), 1U) << "all of it";
}

TEST(FaceFinder, FindsNothingWhereNobodyIs) {
  EXPECT_TRUE(finder().find(Picture(160, 120)).empty());
  std::mt19937 random(1);
  Picture noise(160, 120);
  for (auto& s : noise.y.samples) s = static_cast<std::uint8_t>(random());
  EXPECT_TRUE(finder().find(noise).empty());
}

}  // namespace
}  // namespace fbs
