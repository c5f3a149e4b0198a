#include "cli/video/constant_rate.h"

#include <gtest/gtest.h>

#include <initializer_list>
#include <vector>

#include "cli/video/timestamps.h"

namespace fbs {
namespace {

constexpr Rational kRate{25, 1};
constexpr std::int64_t kPeriod = 3600;  // 1/90000 s

/// Which picture each slot shows, for pictures at these times in periods.
std::vector<int> shown(std::initializer_list<double> times, RateChange* change = nullptr) {
  ConstantRate rate(kRate);
  std::vector<int> slots;
  int number = 0, last = -1;
  for (const double time : times) {
    const auto step = rate.next(static_cast<std::int64_t>(time * kPeriod));
    slots.insert(slots.end(), static_cast<std::size_t>(step.repeats), last);
    if (step.kept) slots.push_back(last = number);
    ++number;
  }
  if (change != nullptr) *change = rate.change();
  return slots;
}

TEST(ConstantRate, RegularPicturesAreWrittenOnce) {
  for (const Rational rate : {Rational{24000, 1001}, Rational{30, 1}, Rational{1000, 1}, Rational{1, 100}}) {
    ConstantRate slots(rate);
    for (int i = 0; i < 100000; ++i) slots.next(77 + regular_pts(i, rate));
    EXPECT_FALSE(slots.change().any()) << rate.num << "/" << rate.den;
  }
}

TEST(ConstantRate, JitterChangesNothing) {
  EXPECT_EQ(shown({0, 1.4, 2.0, 2.6, 4.7, 4.8, 6}), (std::vector<int>{0, 1, 2, 3, 4, 5, 6}));
}

TEST(ConstantRate, AGapIsFilledWithThePictureBefore) {
  RateChange change;
  EXPECT_EQ(shown({0, 1, 4, 5, 7}, &change), (std::vector<int>{0, 1, 1, 1, 2, 3, 3, 4}));
  EXPECT_EQ(change.repeated, 3);
  EXPECT_EQ(change.dropped, 0);
}

TEST(ConstantRate, PicturesThatComeTooFastAreDropped) {
  RateChange change;
  EXPECT_EQ(shown({0, 0.5, 1, 1.5, 2, 2.5, 3}, &change), (std::vector<int>{0, 1, 3, 5}));
  EXPECT_EQ(change.repeated, 0);
  EXPECT_EQ(change.dropped, 3);
}

/// Keeps what is written: the luma of the first sample.
class Recorder final : public VideoSink {
 public:
  explicit Recorder(std::vector<int>& lumas) : lumas_(lumas) {}
  Result<void> write(const Picture& picture, std::int64_t /*pts*/) override {
    lumas_.push_back(picture.y.samples[0]);
    return {};
  }
  Result<void> finish() override { return {}; }

 private:
  std::vector<int>& lumas_;
};

std::vector<int> written(bool hold) {
  std::vector<int> lumas;
  ConstantRateSink sink(std::make_unique<Recorder>(lumas), kRate, hold);
  int number = 10;
  for (const int time : {0, 1, 4, 5}) {
    Picture picture(64, 64);
    picture.y.samples[0] = static_cast<std::uint8_t>(number++);
    EXPECT_TRUE(sink.write(picture, time * kPeriod));
  }
  EXPECT_EQ(sink.change().repeated, 2);
  return lumas;
}

TEST(ConstantRateSink, HoldsPictures) {
  EXPECT_EQ(written(true), (std::vector<int>{10, 11, 11, 11, 12, 13}));
}

TEST(ConstantRateSink, OrWritesEachOnce) {
  EXPECT_EQ(written(false), (std::vector<int>{10, 11, 12, 13}));
}

}  // namespace
}  // namespace fbs
