#include "encoder/shots/shot_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

ShotWatch::Step next(ShotWatch& shots, const Picture& picture) {
  shots.see(picture);
  return shots.next();
}

constexpr double kFps = 10;
constexpr ShotWatch::SceneTraits kFaceScene{true, true}, kOnePattern{true, false}, kSlides{false, true};

/// A shot of its own for each number.
Picture shot(unsigned number) {
  Picture out(128, 96);
  out.y = smooth_plane(128, 96, number);
  return out;
}

Picture lit(Picture picture, double gain) {
  for (auto& s : picture.y.samples) s = static_cast<std::uint8_t>(16 + gain * (s - 16.0));
  return picture;
}

/// Shows pictures of a shot, in which nothing is found and a face followed or not.
/// @return numbers of those for which a face was searched
std::vector<int> searched(ShotWatch& shots, const Picture& picture, int count, bool followed) {
  std::vector<int> out;
  for (int i = 0; i < count; ++i) {
    if (next(shots, picture).searches) out.push_back(i);
    shots.end_picture(followed);
  }
  return out;
}

/// A video that has begun with a scene.
ShotWatch begun(const Picture& picture, const ShotWatch::SceneTraits& scene) {
  ShotWatch shots(kFps);
  EXPECT_TRUE(next(shots, picture).searches);
  EXPECT_TRUE(shots.scene_begins(scene.has_face));
  shots.begin_scene(scene);
  shots.end_picture(scene.has_face);
  return shots;
}

TEST(ShotWatch, TheFirstPictureBeginsASceneWithOrWithoutAFace) {
  for (const bool face : {false, true}) {
    ShotWatch shots(kFps);
    const ShotWatch::Step step = next(shots, shot(1));
    EXPECT_FALSE(step.cut);
    EXPECT_TRUE(step.searches && step.all_sizes);
    EXPECT_FALSE(step.recognises) << "there is no scene to ask";
    EXPECT_TRUE(shots.scene_begins(face));
  }
}

TEST(ShotWatch, NobodySearchesWhileAFaceIsFollowed) {
  ShotWatch shots = begun(shot(1), kFaceScene);
  EXPECT_TRUE(searched(shots, shot(1), 40, true).empty());
}

TEST(ShotWatch, WithoutAFaceEveryFifthPictureIsSearched) {
  ShotWatch shots = begun(shot(1), kSlides);
  EXPECT_EQ(searched(shots, shot(1), 15, false), (std::vector<int>{4, 9, 14}));
  EXPECT_FALSE(shots.scene_begins(false)) << "the scene carries what has no face";
  EXPECT_TRUE(shots.scene_begins(true));
}

TEST(ShotWatch, AfterTwoSecondsALostFaceMayBeAnother) {
  ShotWatch shots = begun(shot(1), kFaceScene);
  EXPECT_TRUE(searched(shots, shot(1), 20, false).empty());
  const ShotWatch::Step step = next(shots, shot(1));
  EXPECT_TRUE(step.searches && step.recognises);
  EXPECT_FALSE(shots.scene_begins(false)) << "a face lost within a shot keeps its scene";
}

TEST(ShotWatch, ACutAsksTheSceneBeforeItSearches) {
  ShotWatch shots = begun(shot(1), kFaceScene);
  const ShotWatch::Step step = next(shots, shot(2));
  EXPECT_TRUE(step.cut && step.searches && step.recognises);
  shots.recognised();
  shots.end_picture(true);
  EXPECT_TRUE(searched(shots, shot(2), 20, true).empty());
}

TEST(ShotWatch, ASceneWithOnePatternEndsWithItsShot) {
  ShotWatch shots = begun(shot(1), kOnePattern);
  const ShotWatch::Step step = next(shots, shot(2));
  EXPECT_TRUE(step.cut && step.searches);
  EXPECT_FALSE(step.recognises);
  EXPECT_TRUE(shots.scene_begins(false));
}

TEST(ShotWatch, AFaceCarriesAnotherShotForASecond) {
  ShotWatch shots = begun(shot(1), kFaceScene);
  int begins = -1;
  for (int i = 0; i < 30 && begins < 0; ++i) {
    if (next(shots, shot(2)).searches && shots.scene_begins(false)) begins = i;
    shots.end_picture(false);
  }
  EXPECT_EQ(begins, 10);
}

TEST(ShotWatch, ASceneBeginsAgainWhenTheLightHasCome) {
  for (const bool face : {false, true}) {
    ShotWatch shots = begun(lit(shot(1), 0.05), kFaceScene);
    int begins = -1;
    for (int i = 1; i < 60 && begins < 0; ++i) {
      const ShotWatch::Step step = next(shots, lit(shot(1), std::min(1.0, 0.05 + i / 20.0)));
      if (step.searches) {
        EXPECT_FALSE(step.recognises);
        EXPECT_EQ(shots.scene_begins(face), face) << "better dark than lost";
        begins = i;
      }
      shots.end_picture(true);
    }
    EXPECT_GE(begins, 18);
    EXPECT_LE(begins, 30);
  }
}

}  // namespace
}  // namespace fbs
