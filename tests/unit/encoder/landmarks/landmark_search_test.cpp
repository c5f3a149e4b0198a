#include "encoder/landmarks/landmark_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "encoder/image/planes.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

const LandmarkSearch& search() {
  static const LandmarkSearch s(*load_landmarks());
  return s;
}

/// Where the talker's face is, `off` eye distances aside and `scale` times as large.
FacePlace place_of(const TalkerClip& clip, int frame, glm::dvec2 off = {0, 0}, double scale = 1) {
  const FacePlace true_place = fbs::place_of(clip.shape(frame));
  return {true_place.centre + off * true_place.eye_distance_px, true_place.eye_distance_px * scale};
}

/// Mean distance of the landmarks from the truth, eye distances.
double error_of(const FoundLandmarks& found, const TalkerClip& clip, int frame) {
  const Shape truth = clip.shape(frame);
  double sum = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const glm::dvec2 d = found.points[k] - glm::dvec2(truth[k]);
    sum += std::hypot(d.x, d.y);
  }
  return sum / kLandmarkCount / place_of(clip, frame).eye_distance_px;
}

TEST(LandmarkSearch, FindsTheTalkersAtEverySize) {
  for (const auto& [w, h] : {std::pair{67, 65}, {176, 144}, {352, 288}, {720, 1280}}) {
    TalkerClip clip(talker_settings(w, h, 1));
    const FoundLandmarks found = search().find(view(clip[0].y), place_of(clip, 0));
    EXPECT_LT(error_of(found, clip, 0), h < 100 ? 0.12 : 0.06) << w;
    EXPECT_GT(found.belief, 0.5) << w;
  }
}

TEST(LandmarkSearch, FindsThemInManyPoses) {
  TalkerClip clip(talker_settings(264, 216, 300));
  for (int i = 0; i < 300; i += 25) {
    const FoundLandmarks found = search().find(view(clip[i].y), place_of(clip, i));
    EXPECT_LT(error_of(found, clip, i), 0.08) << i;
    EXPECT_GT(found.belief, 0.5) << i;
  }
}

TEST(LandmarkSearch, NeedsThePlaceOnlyRoughly) {
  TalkerClip clip(talker_settings(264, 216, 1));
  for (const glm::dvec2 off : {glm::dvec2(0.15, 0), {-0.15, 0.1}, {0, -0.2}})
    for (const double scale : {0.85, 1.2})
      EXPECT_LT(error_of(search().find(view(clip[0].y), place_of(clip, 0, off, scale)), clip, 0), 0.07)
          << off.x << ' ' << off.y << ' ' << scale;
}

TEST(LandmarkSearch, FollowsFromTheLandmarksBefore) {
  TalkerClip clip(talker_settings(264, 216, 60));
  Shape last = clip.shape(0);
  for (int i = 0; i < 60; i += 4) {
    const FoundLandmarks found = search().follow(view(clip[i].y), last);
    EXPECT_LT(error_of(found, clip, i), 0.08) << i;
    EXPECT_GT(found.belief, 0.5) << i;
    std::ranges::copy(found.points, last.begin());
  }
}

TEST(LandmarkSearch, BelievesNothingWhereThereIsNoFace) {
  TalkerClip clip(talker_settings(264, 216, 1));
  EXPECT_LT(search().find(view(clip[0].y), place_of(clip, 0, {2.5, -1})).belief, 0.2) << "beside the face";
  EXPECT_LT(search().find(view(clip[0].y), place_of(clip, 0, {0, 0.6}, 0.4)).belief, 0.2)
      << "mouth as a face";
  std::mt19937 random(1);
  cv::Mat1b noise(200, 200);
  for (std::uint8_t& v : noise) v = static_cast<std::uint8_t>(random());
  const cv::Mat1b flat(200, 200, std::uint8_t{128});
  for (const cv::Mat1b& picture : {noise, flat}) {
    const FoundLandmarks found = search().find(picture, {{100, 100}, 30});
    EXPECT_LT(found.belief, 0.2);
    for (const glm::dvec2 p : found.points) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
  }
}

TEST(LandmarkSearch, IsHarmlessAtThePicturesBorder) {
  for (const glm::dvec2 at : {glm::dvec2(0, 0), {64, 64}, {-100, 30}}) {
    const FoundLandmarks found = search().find(cv::Mat1b(64, 64, std::uint8_t{10}), {at, 30});
    for (const glm::dvec2 p : found.points) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
  }
}

}  // namespace
}  // namespace fbs
