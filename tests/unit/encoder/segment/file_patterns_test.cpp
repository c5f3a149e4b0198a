// The second pass through the whole encoder, on the generated talker.
#include "encoder/segment/file_patterns.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "bitstream/packet.h"
#include "common/quality.h"
#include "tests/unit/encode_decode.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

constexpr int kCount = 40;

TalkerClip clip(std::uint32_t fps) {
  auto settings = talker_settings(128, 96, kCount);
  settings.frame_rate = {fps, 1};
  settings.eye_distance = 0.2F;
  return TalkerClip(settings);
}

/// A stream, its packets by type, and its pictures.
struct Coded {
  std::vector<std::uint8_t> stream;
  std::map<PacketType, int> packets;
  std::vector<Picture> pictures;
  std::vector<std::size_t> patterns;  ///< in the decoder's store, at each picture
  std::vector<PatternRecord> records;
  double psnr = 0;
};

std::vector<std::uint8_t> encoded(TalkerClip& source, const EncoderSettings& settings) {
  auto stream = encode_pictures(source.format(), settings, source.count(), [&](int i) { return source[i]; });
  EXPECT_TRUE(stream) << stream.error().text;
  return *stream;
}

std::map<PacketType, int> packets_of(const std::vector<std::uint8_t>& stream) {
  PacketReader reader;
  reader.feed(stream);
  reader.close();
  std::map<PacketType, int> out;
  for (;;) {
    const auto read = reader.next();
    EXPECT_TRUE(read);
    if (!read || read->status != ReadStatus::kPacket) return out;
    ++out[read->packet.type];
  }
}

Coded coded(TalkerClip source, const EncoderSettings& settings) {
  Coded out;
  out.stream = encoded(source, settings);
  out.packets = packets_of(out.stream);
  StreamDecoder decoder;
  decoder.feed(out.stream);
  decoder.close();
  decoder.record_patterns();
  SquaredError error;
  const auto end = decode_pictures(decoder, [&](StreamDecoder&) {
    out.pictures.emplace_back();
    EXPECT_TRUE(decoder.render(out.pictures.back()));
    out.patterns.push_back(decoder.scene().patterns.size());
    error += squared_error(out.pictures.back().y, source[static_cast<int>(out.pictures.size()) - 1].y);
  });
  EXPECT_TRUE(end) << end.error().text;
  out.records = decoder.pattern_records();
  out.psnr = error.psnr();
  return out;
}

Coded coded(std::uint32_t fps, const EncoderSettings& settings) {
  return coded(clip(fps), settings);
}

EncoderSettings with_patterns(int count) {
  EncoderSettings s;
  s.patterns = count;
  return s;
}

TEST(FilePatterns, EachPictureIsBlendedOnceFromThePatternsAskedFor) {
  const Coded c = coded(10, with_patterns(6));
  ASSERT_EQ(c.pictures.size(), static_cast<std::size_t>(kCount));
  EXPECT_EQ(c.records.size(), 6U);
  EXPECT_LT(c.packets.at(PacketType::kPattern), 6) << "some share a packet";
  EXPECT_GE(c.packets.at(PacketType::kMotion), 4) << "groups of a second";
  EXPECT_EQ(c.packets.at(PacketType::kBlend), c.packets.at(PacketType::kMotion)) << "one for each group";
  EXPECT_EQ(c.patterns.front(), 1U) << "the first group is shown before more patterns arrive";
  EXPECT_EQ(c.patterns.back(), 6U);
}

TEST(FilePatterns, OnePatternNeedsNoBlends) {
  const Coded c = coded(10, with_patterns(1));
  ASSERT_EQ(c.pictures.size(), static_cast<std::size_t>(kCount));
  EXPECT_EQ(c.packets.at(PacketType::kPattern), 1);
  EXPECT_EQ(c.packets.count(PacketType::kBlend), 0U);
}

TEST(FilePatterns, MorePatternsDrawPicturesBetter) {
  EXPECT_GT(coded(10, with_patterns(8)).psnr, coded(10, with_patterns(2)).psnr + 0.3);
}

TEST(FilePatterns, SolvedPatternsDrawPicturesBetterThanPictures) {
  EncoderSettings as_they_are = with_patterns(6), solved = as_they_are;
  as_they_are.effort = 1;
  solved.effort = 2;
  EXPECT_GT(coded(10, solved).psnr, coded(10, as_they_are).psnr);
}

// At two pictures a second and quality 100, 63 patterns are used up after 11 seconds.
TEST(FilePatterns, ASecondSegmentReplacesPatterns) {
  EncoderSettings settings;
  settings.quality = 100;
  const Coded c = coded(2, settings);
  ASSERT_EQ(c.pictures.size(), static_cast<std::size_t>(kCount));
  EXPECT_GT(c.records.size(), c.patterns.back()) << "slots are used again";
  EXPECT_EQ(c.packets.at(PacketType::kBlend), c.packets.at(PacketType::kMotion));
  TalkerClip source = clip(2);
  const auto psnr = [&](int from, int to) {
    SquaredError e;
    for (int i = from; i < to; ++i) e += squared_error(c.pictures[i].y, source[i].y);
    return e.psnr();
  };
  EXPECT_NEAR(psnr(24, kCount), psnr(2, 24), 2) << "drawn from the patterns that the encoder has in mind";
}

TEST(FilePatterns, AShortClipUsesAllItsPatterns) {
  auto settings = talker_settings(128, 96, 8);
  settings.frame_rate = {10, 1};
  settings.eye_distance = 0.2F;
  const Coded c = coded(TalkerClip(settings), with_patterns(4));
  EXPECT_EQ(c.records.size(), 4U);
  EXPECT_EQ(c.packets.at(PacketType::kBlend), c.packets.at(PacketType::kMotion));
}

TEST(FilePatterns, ARateThatCannotBeReachedGivesTheSmallestStream) {
  EncoderSettings low, lowest;
  low.bitrate = 3;
  lowest.bitrate = 0.01;  // less than the head of the scene takes
  const Coded a = coded(10, low), b = coded(10, lowest);
  EXPECT_EQ(b.pictures.size(), static_cast<std::size_t>(kCount));
  EXPECT_LT(b.stream.size(), a.stream.size());
  EXPECT_NEAR(static_cast<double>(a.stream.size()) * 8 / (kCount / 10.0) / 1000, 3, 0.6);
}

// At 10 pictures a second by the header, and 2.5 by their durations.
TEST(FilePatterns, ARateIsReckonedFromTheDurationsOfPictures) {
  EncoderSettings settings;
  settings.bitrate = 3;
  TalkerClip source = clip(10);
  const std::vector<std::uint32_t> durations(kCount, 36'000);
  const auto stream = encode_pictures(
      source.format(), settings, kCount, [&](int i) { return source[i]; }, durations);
  ASSERT_TRUE(stream) << stream.error().text;
  EXPECT_NEAR(static_cast<double>(stream->size()) * 8e-3 / (kCount / 2.5), 3, 0.15);
}

TEST(FilePatterns, ASegmentEndsByTheDurationsOfPictures) {
  VideoFormat format;
  format.width = 128, format.height = 96, format.frame_rate = {10, 1};
  for (const std::uint32_t duration : {0U, 3000U, 36'000U}) {
    FilePatternSettings settings;
    settings.point = PatternPoint::at(0);
    PatternStage stage(format, settings, {});
    stage.decide_by(std::make_unique<FilePatterns>(stage, settings));
    const std::vector<std::uint32_t> group(20, duration);
    double seconds = 0;
    while (!stage.segment_ends(group.size())) {
      for (std::size_t i = 0; i < group.size(); ++i)
        ASSERT_TRUE(stage.add(Picture(format.width, format.height)));
      stage.end_group(group);
      seconds += static_cast<double>(group.size()) * (duration > 0 ? duration : 9000) / kTicksPerSecond;
    }
    EXPECT_NEAR(seconds, kSegmentSeconds, 8) << duration;
    EXPECT_GE(seconds, kSegmentSeconds - 1e-9) << duration;
  }
}

// A decoder keeps no more pictures waiting than kMaxWaitingPictures.
TEST(FilePatterns, SegmentEndsBeforeTooManyPicturesWait) {
  VideoFormat format;
  format.width = 128, format.height = 96;
  for (const std::size_t count : {0, 4}) {
    for (const std::uint32_t fps : {25U, 240U}) {
      format.frame_rate = {fps, 1};
      FilePatternSettings settings;
      settings.point = PatternPoint::at(0);
      settings.count = count;
      PatternStage stage(format, settings, {});
      stage.decide_by(std::make_unique<FilePatterns>(stage, settings));
      const std::vector<State> group(kMaxGroupPictures);
      const Picture grey(format.width, format.height);
      int pictures = 0;
      while (!stage.segment_ends(kMaxGroupPictures) && pictures < 2 * kMaxWaitingPictures) {
        for (int i = 0; i < kMaxGroupPictures; ++i) ASSERT_TRUE(stage.add(grey));
        stage.add(group, {});
        pictures += kMaxGroupPictures;
      }
      EXPECT_LE(pictures, kMaxWaitingPictures) << count << " patterns, " << fps << " pictures a second";
    }
  }
}

}  // namespace
}  // namespace fbs
