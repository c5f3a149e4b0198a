#include "bitstream/motion/track_coder.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

constexpr QuantiserSteps kFinest{1, 1, 1, 1, 1};

// SPEC 5.4
TEST(TrackContexts, ClassesAreThoseOfTheFormat) {
  std::vector<std::size_t> lengths, places;
  for (int length = 1; length <= 10; ++length) lengths.push_back(length_class(length));
  EXPECT_EQ(lengths, (std::vector<std::size_t>{0, 1, 2, 2, 3, 3, 3, 3, 4, 4}));
  for (const std::size_t place : {0, 1, 2, 3, 4, 7, 8, 15, 16, 35}) places.push_back(place_class(place));
  EXPECT_EQ(places, (std::vector<std::size_t>{0, 1, 2, 2, 3, 3, 4, 4, 5, 5}));
  EXPECT_EQ((std::array{sign_class(0), sign_class(9), sign_class(-9)}),
            (std::array<std::size_t, 3>{0, 1, 2}));
  EXPECT_EQ((std::array{size_class(0), size_class(-1), size_class(-9)}),
            (std::array<std::size_t, 3>{0, 1, 2}));
}

TEST(TrackCoder, RoundTripsEverySpan) {
  const CodedLimits limits(kFinest, kAllParts);
  RangeEncoder encoder;
  TrackContexts contexts;
  TrackHistory history;
  TrackCoder writer(encoder, limits, contexts, history);
  for (std::int32_t left = 1; left <= 20; ++left)
    for (std::int32_t length = 1; length <= left; ++length) writer.span(3, left, length % 2 == 0, length);
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  contexts = {};
  TrackCoder reader(decoder, limits, contexts, history);
  for (std::int32_t left = 1; left <= 20; ++left)
    for (std::int32_t length = 1; length <= left; ++length)
      ASSERT_EQ(reader.span(3, left, length % 2 == 0, 0), length) << left;
  EXPECT_TRUE(decoder.ok() && decoder.at_end());
}

TEST(TrackCoder, RoundTripsKnotsOfAnyMagnitude) {
  const CodedLimits limits(kFinest, kAllParts);
  std::mt19937 random(1);
  for (std::size_t part = 0; part < kPartCount; ++part) {
    std::vector<Knot> knots(1);
    if (part == index_of(PartId::kPose)) knots[0].value[kLogScale] = kMaxLogScale / 2;
    for (int reach : {0, 1, 6, 7, 8, 100, 1000}) {
      Knot knot = knots.back();
      for (std::size_t k = 0; k < kPartSizes[part]; ++k)
        knot.value[k] += static_cast<int>(random() % (2 * reach + 1)) - reach;
      knots.push_back(knot);
    }
    RangeEncoder encoder;
    TrackContexts contexts;
    TrackHistory history;
    TrackCoder writer(encoder, limits, contexts, history);
    for (std::size_t k = 1; k < knots.size(); ++k) ASSERT_TRUE(writer.knot(part, 3, knots[k - 1], knots[k]));
    const auto bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    TrackContexts read_contexts;
    TrackHistory read_history;
    TrackCoder reader(decoder, limits, read_contexts, read_history);
    for (std::size_t k = 1; k < knots.size(); ++k) {
      Knot knot;
      ASSERT_TRUE(reader.knot(part, 3, knots[k - 1], knot));
      EXPECT_EQ(knot, knots[k]) << kPartNames[part] << ' ' << k;
    }
    EXPECT_EQ(read_history.change, history.change);
    EXPECT_EQ(read_history.older_change, history.older_change);
    EXPECT_EQ(read_history.moves, history.moves);
  }
}

// SPEC 5.4: a part at rest keeps the changes of its last motion.
TEST(TrackCoder, HistoryIsOfSpansInWhichThePartMoved) {
  const CodedLimits limits(kFinest, kAllParts);
  RangeEncoder encoder;
  TrackContexts contexts;
  TrackHistory history;
  TrackCoder writer(encoder, limits, contexts, history);
  const std::size_t part = index_of(PartId::kLight);
  Knot a, b, c;
  b.value[0] = 4;
  c.value[0] = 1;
  writer.knot(part, 1, a, b);
  writer.knot(part, 1, b, b);
  writer.knot(part, 1, b, c);
  EXPECT_EQ(history.change[kPartFirst[part]], -3);
  EXPECT_EQ(history.older_change[kPartFirst[part]], 4);
  EXPECT_EQ(history.moves[part] & 7, 5);
}

TEST(TrackCoder, ReportsANumberOutOfRange) {
  const CodedLimits wide(kFinest, kAllParts);
  const CodedLimits narrow({1, 1, 1, kMaxLight, 1}, kAllParts);
  RangeEncoder encoder;
  TrackContexts contexts;
  TrackHistory history;
  Knot a, b;
  b.value[2] = 2;
  TrackCoder writer(encoder, wide, contexts, history);
  ASSERT_TRUE(writer.knot(index_of(PartId::kLight), 1, a, b));
  const auto bytes = encoder.finish();
  RangeDecoder decoder(bytes);
  contexts = {};
  history = {};
  TrackCoder reader(decoder, narrow, contexts, history);
  Knot read;
  EXPECT_FALSE(reader.knot(index_of(PartId::kLight), 1, a, read));
}

}  // namespace
}  // namespace fbs
