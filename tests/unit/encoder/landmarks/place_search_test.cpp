#include "encoder/landmarks/place_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "encoder/image/planes.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

const PlaceSearch& search() {
  static const PlaceSearch s(*load_landmarks());
  return s;
}

/// Near enough to search landmarks there.
bool is_near(const FacePlace& found, const FacePlace& wanted) {
  const glm::dvec2 d = found.centre - wanted.centre;
  return std::hypot(d.x, d.y) < 0.3 * wanted.eye_distance_px &&
         std::abs(std::log(found.eye_distance_px / wanted.eye_distance_px)) < 0.3;
}

std::vector<PlaceSearch::Place> found_in(TalkerClip& clip, std::size_t count = 1) {
  const Picture& picture = clip[0];
  const double side = std::min(picture.width(), picture.height());
  return search().find(view(picture.y), {side / 16, side / 2}, count);
}

TEST(PlaceSearch, FindsTheTalkerAtEverySize) {
  for (const auto& [w, h] : {std::pair{64, 64}, {67, 65}, {176, 144}, {352, 288}, {640, 360}}) {
    TalkerClip clip(talker_settings(w, h, 1));
    EXPECT_TRUE(is_near(found_in(clip).at(0).place, place_of(clip.shape(0)))) << w;
  }
}

TEST(PlaceSearch, FindsAFaceThatFillsThePicture) {
  auto settings = talker_settings(200, 200, 1);
  settings.eye_distance = 0.42F;
  TalkerClip clip(settings);
  EXPECT_TRUE(is_near(found_in(clip).at(0).place, place_of(clip.shape(0))));
}

TEST(PlaceSearch, TheBestComesFirstAndNoFaceTwice) {
  TalkerClip clip(talker_settings(352, 288, 1));
  const auto places = found_in(clip, 6);
  ASSERT_EQ(places.size(), 6U);
  EXPECT_TRUE(std::ranges::is_sorted(places, std::greater<>(), &PlaceSearch::Place::score));
  EXPECT_GT(places[0].score, places[1].score + 0.2F);
  const auto near_the_face =
      std::ranges::count_if(places, [&](const auto& p) { return is_near(p.place, place_of(clip.shape(0))); });
  EXPECT_EQ(near_the_face, 1);
}

// While a face is lost its size is roughly known, which makes the search cheap.
TEST(PlaceSearch, LooksOnlyForTheSizesAskedFor) {
  TalkerClip clip(talker_settings(352, 288, 1));
  const double eye = place_of(clip.shape(0)).eye_distance_px;
  for (const auto& p : search().find(view(clip[0].y), {2 * eye, 3 * eye}, 5)) {
    EXPECT_GE(p.place.eye_distance_px, 2 * eye);
    EXPECT_LE(p.place.eye_distance_px, 3 * eye);
    EXPECT_LT(p.score, 0.6F);
  }
  EXPECT_TRUE(search().find(view(clip[0].y), {2 * eye, eye}, 5).empty());
}

TEST(PlaceSearch, ScoresAPlaceAsItsDescriptorSays) {
  TalkerClip clip(talker_settings(352, 288, 1));
  const LandmarkTable table = *load_landmarks();
  const auto best = found_in(clip).at(0);
  std::vector<float> descriptor(kDescriptorSize);
  PlaceSearch::describe(FacePatch(view(clip[0].y), best.place).luma(), table.mean, descriptor);
  EXPECT_NEAR(table.places.score(descriptor)[0] + table.places.offset, best.score, 0.15);
}

TEST(PlaceSearch, IsHarmlessWhereThereIsNothing) {
  for (const cv::Size size : {cv::Size(64, 64), {16, 2000}, {3, 3}})
    for (const auto& p : search().find(cv::Mat1b(size, std::uint8_t{100}), {4, 40}, 3))
      EXPECT_LT(p.score, 0.5F);
}

}  // namespace
}  // namespace fbs
