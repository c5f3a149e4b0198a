// Pictures drawn by several threads before they are asked for.
#include "decoder/draw/pictures_ahead.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr std::uint64_t kPictures = 40;

std::shared_ptr<const Scene> shared_scene(unsigned seed) {
  return std::make_shared<const Scene>(toy_scene(noise_picture(160, 128, seed), even_surround(10, 8, 2)));
}

State state_of(std::uint64_t picture) {
  return toy_state(70 + static_cast<int>(picture % 20), 45 + static_cast<int>(picture % 7));
}

struct Ahead {
  explicit Ahead(int threads) : pictures(threads) {}

  Picture drawn(std::uint64_t number) {
    auto drawn = pictures.take(number, renderer, *scene, state_of(number));
    EXPECT_TRUE(drawn);
    Picture out = *drawn;
    pictures.give_back(std::move(*drawn));
    return out;
  }
  void expect_until(std::uint64_t end) {
    for (std::uint64_t k = 0; k < end; ++k) pictures.expect(k, scene, state_of(k));
  }

  std::shared_ptr<const Scene> scene = shared_scene(1);
  Renderer renderer{};
  PicturesAhead pictures;
};

TEST(PicturesAhead, AreThoseThatOneThreadDraws) {
  for (const int threads : {1, 2, 6}) {
    Ahead ahead(threads);
    for (std::uint64_t k = 0; k < kPictures; ++k) {
      ahead.expect_until(std::min(k + ahead.pictures.most(), kPictures));
      ASSERT_EQ(ahead.drawn(k), rendered(*ahead.scene, state_of(k))) << threads << " threads, " << k;
    }
  }
}

TEST(PicturesAhead, KeepTheSceneTheyWereExpectedIn) {
  Ahead ahead(1);
  const auto before = ahead.scene;
  ahead.expect_until(4);
  ahead.scene = shared_scene(2);
  for (std::uint64_t k = 0; k < 4; ++k) EXPECT_EQ(ahead.drawn(k), rendered(*before, state_of(k)));
  EXPECT_EQ(ahead.drawn(4), rendered(*ahead.scene, state_of(4))) << "one that was not expected";
}

TEST(PicturesAhead, ThoseThatNobodyAsksForAreForgotten) {
  Ahead ahead(2);
  ahead.expect_until(6);
  EXPECT_EQ(ahead.drawn(5), rendered(*ahead.scene, state_of(5)));
  EXPECT_EQ(ahead.drawn(5), rendered(*ahead.scene, state_of(5))) << "drawn again";
  ahead.expect_until(9);
  EXPECT_EQ(ahead.drawn(8), rendered(*ahead.scene, state_of(8)));
}

TEST(PicturesAhead, ErrorsAreThoseOfTheRenderer) {
  Ahead ahead(1);
  const auto nothing = std::make_shared<const Scene>();
  ahead.pictures.expect(0, nothing, {});
  EXPECT_EQ(ahead.pictures.take(0, ahead.renderer, *nothing, {}).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(ahead.pictures.take(1, ahead.renderer, *nothing, {}).error().code, ErrorCode::kInvalidArgument)
      << "one that was not expected";
}

TEST(PicturesAhead, EndsWhilePicturesAreExpected) {
  Ahead ahead(3);
  ahead.expect_until(6);
}

}  // namespace
}  // namespace fbs
