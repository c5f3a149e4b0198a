// Scenes that go on with the same person: each is a place to join.
#include <gtest/gtest.h>

#include "bitstream/packet.h"
#include "common/quality.h"
#include "tests/unit/encode_decode.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

constexpr int kPictures = 40, kPicturesPerSecond = 10;

TalkerClip& clip() {
  static TalkerClip c([] {
    auto settings = talker_settings(128, 96, kPictures);
    settings.frame_rate = {kPicturesPerSecond, 1};
    settings.eye_distance = 0.2F;
    return settings;
  }());
  return c;
}

std::vector<std::uint8_t> encoded(double key_interval, int patterns, int threads = 0) {
  EncoderSettings settings;
  settings.key_interval = key_interval;
  settings.patterns = patterns;
  settings.group_pictures = 5;
  settings.threads = threads;
  auto stream = encode_pictures(clip().format(), settings, kPictures, [](int i) { return clip()[i]; });
  EXPECT_TRUE(stream) << stream.error().text;
  return *stream;
}

std::vector<Picture> decoded(std::span<const std::uint8_t> stream) {
  std::vector<Picture> out;
  const auto end = decode_pictures(stream, [&](StreamDecoder& decoder) {
    out.emplace_back();
    EXPECT_TRUE(decoder.render(out.back()));
  });
  EXPECT_TRUE(end) << end.error().text;
  return out;
}

/// Offsets of the setup packets.
std::vector<std::size_t> scenes_of(std::span<const std::uint8_t> stream) {
  PacketReader reader;
  reader.feed(stream);
  reader.close();
  std::vector<std::size_t> out;
  for (auto read = reader.next(); read && read->status == ReadStatus::kPacket; read = reader.next())
    if (read->packet.type == PacketType::kSetup) out.push_back(read->packet.offset);
  return out;
}

double psnr_of(std::span<const Picture> pictures) {
  SquaredError e;
  for (int i = 0; i < kPictures; ++i) e += squared_error(pictures[i].y, clip()[i].y);
  return e.psnr();
}

class KeyInterval : public testing::TestWithParam<int> {};  // patterns

TEST_P(KeyInterval, ScenesAreNoLonger) {
  const auto stream = encoded(1.2, GetParam());
  const auto scenes = scenes_of(stream);
  EXPECT_GE(scenes.size(), 4U);
  EXPECT_LE(scenes.size(), 6U);
  EXPECT_EQ(decoded(stream).size(), std::size_t{kPictures});
}

TEST_P(KeyInterval, AViewerCanJoinAtEach) {
  const auto stream = encoded(1.2, GetParam());
  const auto all = decoded(stream);
  for (const std::size_t offset : scenes_of(stream)) {
    std::vector<std::uint8_t> rest;
    write_signature(rest);
    rest.insert(rest.end(), stream.begin() + static_cast<std::ptrdiff_t>(offset), stream.end());
    const auto joined = decoded(rest);
    ASSERT_FALSE(joined.empty());
    ASSERT_LE(joined.size(), all.size());
    for (std::size_t i = 0; i < joined.size(); ++i)
      EXPECT_EQ(joined[i].y.samples, all[all.size() - joined.size() + i].y.samples) << offset << ' ' << i;
  }
}

// A scene is blended from its own patterns only, here two.
TEST_P(KeyInterval, PicturesAreFit) {
  EXPECT_GT(psnr_of(decoded(encoded(1.2, GetParam()))), 29);
}

TEST_P(KeyInterval, StreamsAreTheSameForAnyNumberOfThreads) {
  for (const double key_interval : {0.0, 1.2}) {
    const auto alone = encoded(key_interval, GetParam(), 1);
    for (const int threads : {2, 3, 7})
      EXPECT_EQ(encoded(key_interval, GetParam(), threads), alone) << key_interval << " s, " << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(OneAndSeveralPatterns, KeyInterval, testing::Values(0, 1));

}  // namespace
}  // namespace fbs
