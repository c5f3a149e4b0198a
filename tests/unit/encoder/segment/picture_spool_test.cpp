#include "encoder/segment/picture_spool.h"

#include <gtest/gtest.h>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

TEST(PictureSpool, GivesPicturesBackInAnyOrder) {
  PictureSpool spool;
  EXPECT_EQ(spool.count(), 0U);
  for (unsigned k = 0; k < 7; ++k) ASSERT_TRUE(spool.add(noise_picture(67, 65, k)));
  EXPECT_EQ(spool.count(), 7U);
  for (const unsigned k : {3U, 0U, 6U, 6U, 1U, 5U, 2U, 4U}) {
    const auto picture = spool.read(k);
    ASSERT_TRUE(picture);
    EXPECT_EQ(*picture, noise_picture(67, 65, k)) << k;
  }
}

TEST(PictureSpool, TakesPicturesAfterSomeWereRead) {
  PictureSpool spool;
  for (unsigned k = 0; k < 4; ++k) {
    ASSERT_TRUE(spool.add(noise_picture(64, 64, k)));
    EXPECT_EQ(*spool.read(k / 2), noise_picture(64, 64, k / 2));
  }
  for (unsigned k = 0; k < 4; ++k) EXPECT_EQ(*spool.read(k), noise_picture(64, 64, k));
}

// Three of them are more than it keeps in memory.
TEST(PictureSpool, LargePicturesGoOnInAFile) {
  PictureSpool spool;
  for (unsigned k = 0; k < 5; ++k) ASSERT_TRUE(spool.add(noise_picture(1600, 1200, k)));
  for (const unsigned k : {4U, 0U, 3U, 2U, 1U}) EXPECT_EQ(*spool.read(k), noise_picture(1600, 1200, k)) << k;
}

TEST(PictureSpool, SharesThePicturesInMemory) {
  PictureSpool spool;
  const SharedPicture picture = noise_picture(64, 64, 1);
  ASSERT_TRUE(spool.add(picture));
  EXPECT_EQ((*spool.read(0))->y.samples.data(), picture->y.samples.data()) << "not a copy";
}

TEST(PictureSpool, MovesWithItsPictures) {
  PictureSpool spool;
  ASSERT_TRUE(spool.add(noise_picture(64, 64, 1)));
  PictureSpool other = std::move(spool);
  EXPECT_EQ(*other.read(0), noise_picture(64, 64, 1));
}

TEST(PictureQueue, IsFirstInFirstOutWhoeverIsFaster) {
  PictureQueue queue;
  unsigned pushed = 0, popped = 0;
  for (const unsigned count : {1U, 5U, 2U, 0U, 7U}) {
    for (unsigned k = 0; k < count; ++k) ASSERT_TRUE(queue.push(noise_picture(1600, 1200, pushed++)));
    for (unsigned k = 0; k < (count + 1) / 2; ++k)
      EXPECT_EQ(*queue.pop(), noise_picture(1600, 1200, popped++));
  }
  while (popped < pushed) EXPECT_EQ(*queue.pop(), noise_picture(1600, 1200, popped++));
}

}  // namespace
}  // namespace fbs
