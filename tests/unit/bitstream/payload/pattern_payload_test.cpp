#include "bitstream/payload/pattern_payload.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <vector>

namespace fbs {
namespace {

PatternSyntax sample_pattern() {
  PatternSyntax pattern;
  pattern.index = 5;
  pattern.state[kYaw] = -2;
  pattern.state[kShiftX] = 40;
  pattern.state[kLogScale] = 900;
  pattern.state[kFirstCoefficient] = -9;
  pattern.state.back() = 4;
  pattern.av1 = {0x12, 0x00, 0x0A};
  return pattern;
}

Setup sample_setup() {
  Setup setup;
  setup.format.width = 352;
  setup.format.height = 288;
  return setup;
}

TEST(PatternPayload, RoundTrips) {
  const auto payload = encode_pattern(sample_pattern(), sample_setup());
  ASSERT_TRUE(payload);
  const auto read = decode_pattern(*payload, sample_setup());
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, sample_pattern());
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
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.index = kMaxPatterns; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.index = -1; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.av1.clear(); }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.state[kYaw] = 1 << 20; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.state[kLogScale] = -1; }), ErrorCode::kInvalidArgument);
  EXPECT_EQ(code_of([](PatternSyntax& p) { p.state[kPoseCount] = 1; }), ErrorCode::kInvalidArgument);
  const std::vector<std::uint8_t> far = {64, 0, 1};
  EXPECT_EQ(decode_pattern(far, sample_setup()).error().code, ErrorCode::kTooLarge);
  const std::vector<std::uint8_t> endless = {0, 0x7F, 1};
  EXPECT_EQ(decode_pattern(endless, sample_setup()).error().code, ErrorCode::kTruncated);
  const std::vector<std::uint8_t> empty = {0, 0};
  EXPECT_EQ(decode_pattern(empty, sample_setup()).error().code, ErrorCode::kInvalidStream);
}

TEST(PatternPayload, SurvivesRandomBytes) {
  std::mt19937 random(8);
  const auto good = *encode_pattern(sample_pattern(), sample_setup());
  for (int i = 0; i < 20000; ++i) {
    auto payload = good;
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
