#include "bitstream/payload/setup_payload.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "bitstream/packet.h"

namespace fbs {
namespace {

Setup sample_setup() {
  Setup setup;
  setup.before = {1000, 3003000};
  setup.format.width = 352;
  setup.format.height = 288;
  setup.format.frame_rate = {30000, 1001};
  setup.format.pixel_aspect = {12, 11};
  setup.format.range = ColourRange::kFull;
  setup.format.matrix = ColourMatrix::kBt709;
  setup.steps = {300, 65535, 1, 12, 77};
  setup.mouth = {{180, 120, 130}, {20, 110, 140}};
  setup.patterns = 24;
  return setup;
}

TEST(SetupPayload, RoundTrips) {
  const auto payload = encode_setup(sample_setup());
  ASSERT_TRUE(payload);
  EXPECT_LE(payload->size(), 37u);
  const auto read = decode_setup(*payload);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, sample_setup());
}

// SPEC 3.2: there is room for what later versions may add.
TEST(SetupPayload, LargestIsFoundAfterDamage) {
  fbs::Setup setup = sample_setup();
  setup.before = {kMaxStreamPictures, kMaxStreamTime};
  setup.format.width = setup.format.height = kMaxPictureSize;
  setup.format.frame_rate = setup.format.pixel_aspect = {0xFFFFFFFF, 0xFFFFFFFF};
  setup.steps = {65535, 65535, 65535, 65535, 65535};
  setup.contrast = kMinContrast;
  setup.chroma_contrast = kMaxChromaContrast;
  setup.keeps = SceneKeeping::kAndPresent;
  const auto payload = encode_setup(setup);
  ASSERT_TRUE(payload);
  EXPECT_LE(payload->size() + 50, kMaxSearchedPayload);
}

TEST(SetupPayload, EachBoundIsCheckedBothWays) {
  struct Case {
    std::function<void(fbs::Setup&)> breaks;
    ErrorCode code;
  };
  const std::vector<Case> cases = {
      {[](fbs::Setup& s) {
         s.before = {kMaxStreamPictures + 1, kMaxStreamTime};
       },
       ErrorCode::kTooLarge},
      {[](fbs::Setup& s) { s.before.time = kMaxStreamTime + 1; }, ErrorCode::kTooLarge},
      {[](fbs::Setup& s) { s.before.time = s.before.pictures - 1; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.before.time = s.before.pictures * kMaxDuration + 1; },
       ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.before.pictures = 0; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.format.width = kMaxPictureSize + 1; }, ErrorCode::kTooLarge},
      {[](fbs::Setup& s) { s.format.height = kMaxPictureSize + 1; }, ErrorCode::kTooLarge},
      {[](fbs::Setup& s) { s.format.width = kMinPictureSize - 1; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.format.height = 0; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) {
         s.format.frame_rate = {0, 1};
       },
       ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) {
         s.format.frame_rate = {1, 0};
       },
       ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) {
         s.format.frame_rate = {1001, 1};
       },
       ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) {
         s.format.pixel_aspect = {1, 0};
       },
       ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.steps.rotation = 0; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.steps.translation = 65536; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.steps.log_scale = 0; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.steps.light = 0; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.steps.light = kMaxStep + 1; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.steps.control = -1; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.parts = 1 << kPartCount | 1; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.parts = kAllParts & ~1; }, ErrorCode::kInvalidArgument},  // the pose is always
      {[](fbs::Setup& s) { s.format.matrix = static_cast<ColourMatrix>(3); }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.format.range = static_cast<ColourRange>(2); }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.patterns = 0; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.patterns = kMaxPatterns + 1; }, ErrorCode::kTooLarge},
      {[](fbs::Setup& s) { s.contrast = kMinContrast - 1; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.contrast = kContrastOne + 1; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.chroma_contrast = kContrastOne - 2; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.chroma_contrast = kContrastOne + 1; }, ErrorCode::kInvalidArgument},
      {[](fbs::Setup& s) { s.chroma_contrast = kMaxChromaContrast + 2; }, ErrorCode::kInvalidArgument},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    auto setup = sample_setup();
    cases[i].breaks(setup);
    const auto payload = encode_setup(setup);
    ASSERT_FALSE(payload) << i;
    EXPECT_EQ(payload.error().code, cases[i].code) << i;
  }
}

// Payload by hand: version, head, pictures before, time before, width, height, rate, aspect, colour, steps,
// parts, mouth.
TEST(SetupPayload, ReadsKnownBytesAndNamesWhatIsWrong) {
  const std::vector<std::uint8_t> good = {
      kFormatVersion, 3, 2, 9, 64, 65, 25, 1, 1, 1, 0, 1, 2, 3, 4, 5, 12, 70, 126, 138, 45, 126, 139};
  ASSERT_TRUE(decode_setup(good));
  EXPECT_EQ(decode_setup(good)->before, (StreamPosition{2, 9}));
  EXPECT_EQ(decode_setup(good)->format.height, 65);
  EXPECT_EQ(decode_setup(good)->steps, (QuantiserSteps{1, 2, 3, 4, 5}));
  EXPECT_EQ(decode_setup(good)->parts,
            mask_of(PartId::kPose) | mask_of(PartId::kBody) | mask_of(PartId::kGround));
  EXPECT_EQ(decode_setup(good)->mouth, (MouthInterior{{70, 126, 138}, {45, 126, 139}}));
  const auto code_with = [&](std::size_t place, std::uint8_t value) {
    auto bytes = good;
    bytes[place] = value;
    const auto read = decode_setup(bytes);
    return read ? ErrorCode::kInternal : read.error().code;
  };
  EXPECT_EQ(code_with(0, kFormatVersion + 1), ErrorCode::kUnsupported);
  EXPECT_EQ(code_with(0, kVersionWithoutReturns), ErrorCode::kInternal);
  for (std::uint8_t older = 1; older < kVersionWithoutReturns; ++older)
    EXPECT_EQ(code_with(0, older), ErrorCode::kUnsupported);
  EXPECT_EQ(code_with(0, 0), ErrorCode::kInvalidStream);
  EXPECT_EQ(code_with(1, 2), ErrorCode::kUnsupported);
  EXPECT_EQ(code_with(3, 1), ErrorCode::kInvalidStream) << "two pictures in 1/90000 s";
  EXPECT_EQ(code_with(4, 63), ErrorCode::kInvalidStream);
  EXPECT_EQ(code_with(6, 0), ErrorCode::kInvalidStream);
  EXPECT_EQ(code_with(7, 0), ErrorCode::kInvalidStream);
  EXPECT_EQ(code_with(9, 0), ErrorCode::kInvalidStream);
  EXPECT_EQ(code_with(10, 6), ErrorCode::kInvalidStream);
  EXPECT_EQ(code_with(11, 0), ErrorCode::kInvalidStream);
  EXPECT_EQ(code_with(14, 0), ErrorCode::kInvalidStream) << "light";
  EXPECT_EQ(code_with(15, 0), ErrorCode::kInvalidStream) << "control";
  auto unknown_part = good;
  unknown_part[16] = 0x80;
  unknown_part.insert(unknown_part.begin() + 17, 4);  // bit 9 without the pose's: an eleventh part
  EXPECT_EQ(decode_setup(unknown_part).error().code, ErrorCode::kInvalidStream);
  auto large = good;
  large.insert(large.begin() + 4, {0x81});  // width 1 + 128 * 64 = 8193
  EXPECT_EQ(decode_setup(large).error().code, ErrorCode::kTooLarge);
}

// The last fields: patterns and contrasts.
TEST(SetupPayload, StoreOfOnePatternIsNotCoded) {
  auto one = sample_setup();
  one.patterns = 1;
  const auto payload = *encode_setup(one);
  EXPECT_EQ(payload.size() + 1, encode_setup(sample_setup())->size());
  EXPECT_EQ(*decode_setup(payload), one);
  auto bytes = payload;
  bytes.push_back(1);
  EXPECT_EQ(*decode_setup(bytes), one) << "nor need it be left out";
  bytes.back() = 0;
  EXPECT_EQ(decode_setup(bytes).error().code, ErrorCode::kInvalidStream);
  bytes.back() = kMaxPatterns;
  EXPECT_EQ(decode_setup(bytes)->patterns, kMaxPatterns);
  bytes.back() = kMaxPatterns + 1;
  EXPECT_EQ(decode_setup(bytes).error().code, ErrorCode::kTooLarge);
  bytes.back() = 0x80;  // a varint that goes on
  EXPECT_EQ(decode_setup(bytes).error().code, ErrorCode::kTruncated);
}

TEST(SetupPayload, FullContrastIsNotCoded) {
  for (const std::int32_t patterns : {1, 24}) {
    auto setup = sample_setup();
    setup.patterns = patterns;
    setup.contrast = kContrastOne;
    const auto full = *encode_setup(setup);
    EXPECT_EQ(decode_setup(full)->contrast, kContrastOne);
    for (const std::int32_t contrast : {kMinContrast, 220, kContrastOne - 1}) {
      setup.contrast = contrast;
      const auto payload = *encode_setup(setup);
      EXPECT_EQ(payload.size(), full.size() + (patterns == 1 ? 2 : 1));
      EXPECT_EQ(*decode_setup(payload), setup);
    }
  }
  auto payload = *encode_setup(sample_setup());
  payload.push_back(kContrastOne - kMinContrast + 1);
  EXPECT_EQ(decode_setup(payload).error().code, ErrorCode::kInvalidStream);
}

TEST(SetupPayload, FullChromaContrastIsNotCoded) {
  for (const std::int32_t contrast : {kContrastOne, 220}) {
    auto setup = sample_setup();
    setup.contrast = contrast;
    const auto without = *encode_setup(setup);
    for (const std::int32_t chroma : {kContrastOne + 2, 400, kMaxChromaContrast}) {
      setup.chroma_contrast = chroma;
      const auto payload = *encode_setup(setup);
      EXPECT_EQ(payload.size(), without.size() + (contrast == kContrastOne ? 2 : 1));
      EXPECT_EQ(*decode_setup(payload), setup);
    }
  }
  auto payload = *encode_setup(sample_setup());
  payload.insert(payload.end(), {0, (kMaxChromaContrast - kContrastOne) / 2 + 1});
  EXPECT_EQ(decode_setup(payload).error().code, ErrorCode::kInvalidStream);
}

TEST(SetupPayload, WhatBecomesOfScenesBeforeComesLast) {
  auto setup = sample_setup();
  const std::size_t without = encode_setup(setup)->size();
  for (const SceneKeeping keeps : {SceneKeeping::kAside, SceneKeeping::kAndPresent}) {
    setup.keeps = keeps;
    const auto payload = *encode_setup(setup);
    EXPECT_EQ(payload.size(), without + 3);
    EXPECT_EQ(*decode_setup(payload), setup);
  }
  auto payload = *encode_setup(setup);
  payload.back() = 3;
  EXPECT_EQ(decode_setup(payload).error().code, ErrorCode::kInvalidStream);
}

TEST(SetupPayload, IgnoresBytesOfLaterWritersAndReportsMissingOnes) {
  auto payload = *encode_setup(sample_setup());
  payload.pop_back();  // patterns, which may be missing
  for (std::size_t size = 0; size < payload.size(); ++size) {
    const auto read = decode_setup(std::span(payload).first(size));
    ASSERT_FALSE(read) << size;
    EXPECT_EQ(read.error().code, ErrorCode::kTruncated) << size;
  }
  payload.insert(payload.end(), {2, 99});
  EXPECT_TRUE(decode_setup(payload));
}

TEST(SetupPayload, SurvivesRandomBytes) {
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    auto payload = *encode_setup(sample_setup());
    for (unsigned k = 1 + random() % 4; k > 0; --k) {
      payload[random() % payload.size()] = static_cast<std::uint8_t>(random());
    }
    if (const auto read = decode_setup(payload)) {
      EXPECT_TRUE(check_setup(*read));
    }
  }
}

}  // namespace
}  // namespace fbs
