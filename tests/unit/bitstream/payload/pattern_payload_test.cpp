#include "bitstream/payload/pattern_payload.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <random>
#include <vector>

namespace fbs {
namespace {

PatternSyntax sample_pattern() {
  PatternSyntax pattern;
  pattern.state[kYaw] = -2;
  pattern.state[kShiftX] = 40;
  pattern.state[kLogScale] = 900;
  pattern.state[kFirstCoefficient] = -9;
  pattern.state.back() = 4;
  pattern.av1 = {0x12, 0x00, 0x0A};
  return pattern;
}

/// Of a picture whose state the motion has.
PatternSyntax later_pattern() {
  PatternSyntax pattern;
  pattern.slot = 5;
  pattern.picture = 300;
  pattern.av1 = {0x32, 0x00};
  return pattern;
}

Setup sample_setup() {
  Setup setup;
  setup.patterns = 6;
  setup.format.width = 352;
  setup.format.height = 288;
  return setup;
}

TEST(PatternPayload, RoundTrips) {
  for (const PatternSyntax& pattern : {sample_pattern(), later_pattern()}) {
    const auto payload = encode_pattern(pattern, sample_setup());
    ASSERT_TRUE(payload);
    const auto read = decode_pattern(*payload, sample_setup());
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, pattern);
  }
}

// Slot + 1, the number of the picture in two bytes, then the frame.
TEST(PatternPayload, LaterPatternHasNoState) {
  EXPECT_EQ(*encode_pattern(later_pattern(), sample_setup()),
            (std::vector<std::uint8_t>{6, 0xAC, 0x02, 0x32, 0x00}));
}

TEST(PatternPayload, FirstPatternHasPlaceZero) {
  EXPECT_EQ(encode_pattern(sample_pattern(), sample_setup())->front(), 0);
}

TEST(PatternPayload, RefusesWhatBreaksALimit) {
  const auto code_of = [](const std::function<void(PatternSyntax&)>& breaks) {
    PatternSyntax pattern = sample_pattern();
    pattern.state.back() = 0;  // gaze, is not sent
    breaks(pattern);
    auto setup = sample_setup();
    setup.parts = static_cast<PartMask>(mask_of(PartId::kPose) | mask_of(PartId::kMouth));
    const auto payload = encode_pattern(pattern, setup);
    return payload ? ErrorCode::kInternal : payload.error().code;
  };
  EXPECT_EQ(code_of([](PatternSyntax&) {}), ErrorCode::kInternal) << "all else is in order";
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.slot = 1; }), ErrorCode::kInvalidArgument) << "of picture 0";
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.slot = -1; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.picture = -1; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) {
              p.picture = 1;
              p.slot = sample_setup().patterns;
            }),
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.av1.clear(); }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.state[kYaw] = 1 << 20; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.state[kLogScale] = -1; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.state[kPoseCount] = 1; }), ErrorCode::kInvalidArgument);
}

TEST(PatternPayload, NamesWhatIsWrong) {
  const auto code_of = [](const std::vector<std::uint8_t>& payload) {
    const auto read = decode_pattern(payload, sample_setup());
    return read ? ErrorCode::kInternal : read.error().code;
  };
  EXPECT_EQ(code_of({6, 1, 1}), ErrorCode::kInternal) << "the last slot";
  EXPECT_EQ(code_of({7, 1, 1}), ErrorCode::kTooLarge) << "a slot that the setup has not";
  EXPECT_EQ(code_of({2, 0, 1}), ErrorCode::kInvalidStream) << "only the first pattern is of picture 0";
  EXPECT_EQ(code_of({2, 0xFF, 0xFF, 0xFF, 0xFF, 0x07, 1}), ErrorCode::kInternal) << "the last picture";
  EXPECT_EQ(code_of({2, 0x80, 0x80, 0x80, 0x80, 0x08, 1}), ErrorCode::kTooLarge) << "a picture after it";
  EXPECT_EQ(code_of({2, 1}), ErrorCode::kInvalidStream) << "no frame";
  EXPECT_EQ(code_of({2}), ErrorCode::kTruncated);
  EXPECT_EQ(code_of({0, 0x7F, 1}), ErrorCode::kTruncated) << "a state longer than the payload";
  EXPECT_EQ(code_of({0, 0}), ErrorCode::kInvalidStream) << "no frame";
}

TEST(PatternPayload, SurvivesRandomBytes) {
  std::mt19937 random(8);
  const std::array good = {*encode_pattern(sample_pattern(), sample_setup()),
                           *encode_pattern(later_pattern(), sample_setup())};
  for (int i = 0; i < 20000; ++i) {
    auto payload = good[i % 2];
    for (unsigned k = 1 + random() % 6; k > 0; --k) {
      payload[random() % payload.size()] = static_cast<std::uint8_t>(random());
    }
    if (const auto read = decode_pattern(payload, sample_setup())) {
      EXPECT_TRUE(encode_pattern(*read, sample_setup()));
    }
  }
}

}  // namespace
}  // namespace fbs
