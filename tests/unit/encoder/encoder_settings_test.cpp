// Settings that an encoder refuses.
#include <gtest/gtest.h>

#include <limits>

#include "encoder/effort.h"
#include "encoder/encoder.h"

namespace fbs {
namespace {

EncoderSettings quality(int q) {
  EncoderSettings s;
  s.quality = q;
  return s;
}

TEST(EncoderSettings, AreRefusedOutOfRange) {
  VideoFormat format;
  format.width = 160;
  format.height = 128;
  const auto refusal = [&](const VideoFormat& f, const EncoderSettings& s) {
    const auto encoder = Encoder::create(f, s);
    return encoder ? ErrorCode::kInternal : encoder.error().code;
  };
  EncoderSettings settings;
  EXPECT_EQ(refusal(format, quality(-1)), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refusal(format, quality(101)), ErrorCode::kInvalidArgument);
  settings.group_pictures = 257;
  EXPECT_EQ(refusal(format, settings), ErrorCode::kInvalidArgument);
  settings = {};
  settings.face = -1;
  EXPECT_EQ(refusal(format, settings), ErrorCode::kInvalidArgument);
  for (const int patterns : {-1, kMaxPatterns + 1}) {
    settings = {};
    settings.patterns = patterns;
    EXPECT_EQ(refusal(format, settings), ErrorCode::kInvalidArgument) << patterns;
  }
  settings = {};
  settings.pattern_quantiser = 64;
  EXPECT_EQ(refusal(format, settings), ErrorCode::kInvalidArgument);
  settings = {};
  for (const int effort : {-1, Effort::kMost + 1}) {
    settings.effort = effort;
    EXPECT_EQ(refusal(format, settings), ErrorCode::kInvalidArgument) << effort;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1.0, kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    const auto with = [&](auto set) {
      EncoderSettings s;
      set(s);
      return refusal(format, s);
    };
    EXPECT_EQ(with([&](auto& s) { s.bitrate = bad; }), ErrorCode::kInvalidArgument) << bad;
    EXPECT_EQ(with([&](auto& s) { s.motion_bitrate = bad; }), ErrorCode::kInvalidArgument) << bad;
    EXPECT_EQ(with([&](auto& s) { s.seconds = bad; }), ErrorCode::kInvalidArgument) << bad;
    EXPECT_EQ(with([&](auto& s) { s.key_interval = bad; }), ErrorCode::kInvalidArgument) << bad;
    EXPECT_EQ(with([&](auto& s) { s.live.emplace().delay = bad; }), ErrorCode::kInvalidArgument) << bad;
    EXPECT_EQ(with([&](auto& s) { s.live.emplace().buffer = bad; }), ErrorCode::kInvalidArgument) << bad;
    EXPECT_EQ(with([&](auto& s) { s.bitrate = 5, s.start = bad; }), ErrorCode::kInvalidArgument) << bad;
  }
  EncoderSettings starts;
  starts.start = 1;
  EXPECT_EQ(refusal(format, starts), ErrorCode::kInvalidArgument) << "of no rate";
  starts.bitrate = 5;
  EXPECT_TRUE(Encoder::create(format, starts));
  starts.live.emplace().resilience = Resilience::kStrong;
  EXPECT_EQ(refusal(format, starts), ErrorCode::kInvalidArgument);
  starts.live.emplace().join = 20;
  EXPECT_EQ(refusal(format, starts), ErrorCode::kInvalidArgument);
  starts.start = 0;
  EXPECT_TRUE(Encoder::create(format, starts));
  starts = {};
  starts.bitrate = 5;
  starts.start = 1;
  starts.patterns = 1;
  EXPECT_EQ(refusal(format, starts), ErrorCode::kInvalidArgument);
  VideoFormat small = format, large = format;
  small.width = 63;
  large.height = 8193;
  EXPECT_EQ(refusal(small, {}), ErrorCode::kInvalidArgument);
  EXPECT_NE(refusal(large, {}), ErrorCode::kInternal);
}

}  // namespace
}  // namespace fbs
