#include "cli/play/window_fit.h"

#include <gtest/gtest.h>

namespace fbs::cli {
namespace {

TEST(WindowFit, PixelsBecomeSquareByGrowing) {
  EXPECT_EQ(square_pixels({704, 576}, {128, 117}), (Size{770, 576}));
  EXPECT_EQ(square_pixels({704, 576}, {1, 2}), (Size{704, 1152}));
  EXPECT_EQ(square_pixels({704, 576}, {1, 1}), (Size{704, 576}));
}

TEST(WindowFit, UnknownAndAbsurdAspectsAreTakenForSquare) {
  for (const Rational aspect : {Rational{0, 1}, Rational{1, 0}, Rational{1000, 1}, Rational{1, 9}})
    EXPECT_EQ(square_pixels({64, 48}, aspect), (Size{64, 48}));
}

TEST(WindowFit, WindowIsNeverLargerThanTheScreen) {
  EXPECT_EQ(shrunk_to({720, 1280}, {1024, 736}), (Size{414, 736}));
  EXPECT_EQ(shrunk_to({1920, 480}, {1024, 736}), (Size{1024, 256}));
  EXPECT_EQ(shrunk_to({352, 288}, {1024, 736}), (Size{352, 288}));
}

TEST(WindowFit, LetterboxKeepsTheShapeInTheMiddle) {
  EXPECT_EQ(letterbox({720, 1280}, {1024, 768}), (Box{296, 0, 432, 768}));
  EXPECT_EQ(letterbox({200, 100}, {400, 400}), (Box{0, 100, 400, 200}));
}

TEST(WindowFit, ClicksOnTheBarAreThoseAtTheBottom) {
  const Size window{400, 300};
  EXPECT_LT(place_on_bar(200, 100, window), 0);
  EXPECT_NEAR(place_on_bar(200, 299, window), 0.5, 0.01);
  EXPECT_EQ(place_on_bar(-40, 299, window), 0);
  EXPECT_EQ(place_on_bar(900, 299, window), 1);
}

}  // namespace
}  // namespace fbs::cli
