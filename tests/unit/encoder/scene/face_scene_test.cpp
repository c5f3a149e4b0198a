#include "encoder/scene/face_scene.h"

#include <gtest/gtest.h>

#include "encoder/encoder.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

constexpr int kPictures = 6;

/// States as reported after each picture.
std::vector<State> reported(int threads) {
  TalkerClip clip(talker_settings(128, 96, kPictures));
  EncoderSettings settings;
  settings.threads = threads;
  auto encoder = Encoder::create(clip.format(), settings);
  EXPECT_TRUE(encoder);
  std::vector<State> out;
  for (int i = 0; i < kPictures; ++i) {
    EXPECT_TRUE(encoder->push(clip[i]));
    out.push_back(encoder->analysis().state);
    EXPECT_EQ(encoder->report().pictures, out.size());
  }
  return out;
}

TEST(FaceScene, AnyNumberOfThreadsTellsOfThePicturePushedLast) {
  const std::vector<State> one = reported(1);
  EXPECT_NE(one[0].control, one[kPictures - 1].control) << "the talker talks";
  for (const int threads : {2, 5}) {
    const std::vector<State> several = reported(threads);
    for (std::size_t t = 0; t < one.size(); ++t) {
      EXPECT_EQ(several[t].pose, one[t].pose) << t;
      EXPECT_EQ(several[t].control, one[t].control) << t;
      EXPECT_EQ(several[t].light, one[t].light) << t;
    }
  }
}

}  // namespace
}  // namespace fbs
