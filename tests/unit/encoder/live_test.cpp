// Encoding as it happens: packets leave with each group, without waiting for later ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "bitstream/packet.h"
#include "bitstream/scene/scene_reader.h"
#include "common/quality.h"
#include "decoder/stream/scene_index.h"
#include "tests/unit/encode_decode.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

constexpr int kPictures = 60, kPicturesPerSecond = 20, kGroup = 4;

TalkerClip& clip() {
  static TalkerClip c([] {
    auto settings = talker_settings(128, 96, kPictures);
    settings.frame_rate = {kPicturesPerSecond, 1};
    settings.eye_distance = 0.2F;
    return settings;
  }());
  return c;
}

/// @param delay  pictures
EncoderSettings live_settings(int delay = kGroup) {
  EncoderSettings settings;
  settings.live.emplace();
  settings.live->delay = static_cast<double>(delay) / kPicturesPerSecond;
  settings.threads = 1;
  return settings;
}

/// Encodes and decodes at once.
class LiveLine {
 public:
  explicit LiveLine(const EncoderSettings& settings = live_settings())
      : encoder_(*Encoder::create(clip().format(), settings)) {}

  void push(const Picture& picture) {
    ASSERT_TRUE(encoder_.push(picture));
    pass_on();
  }
  void request_scene() { ASSERT_TRUE(encoder_.request_scene()); }
  void lose_patterns() { ASSERT_TRUE(encoder_.lose_patterns()); }
  void finish() {
    ASSERT_TRUE(encoder_.finish());
    pass_on();
  }

  std::vector<std::uint8_t> stream;
  std::vector<Picture> shown;
  ByteCount bytes;
  std::size_t patterns = 0;

 private:
  void pass_on() {
    const auto taken = encoder_.take();
    stream.insert(stream.end(), taken.begin(), taken.end());
    decoder_.feed(taken);
    const auto status = decode_pictures(decoder_, [&](StreamDecoder&) {
      shown.emplace_back();
      ASSERT_TRUE(decoder_.render(shown.back()));
    });
    ASSERT_TRUE(status) << status.error().text;
    bytes = decoder_.bytes();
    patterns = decoder_.scene().patterns.size();
  }

  Encoder encoder_;
  StreamDecoder decoder_;
};

double psnr_of(std::span<const Picture> shown) {
  SquaredError e;
  for (std::size_t i = 0; i < shown.size(); ++i)
    e += squared_error(shown[i].y, clip()[static_cast<int>(i)].y);
  return e.psnr();
}

TEST(Live, PicturesAreShownAfterTheDelay) {
  for (const int delay : {kGroup, 18, 26}) {
    LiveLine line(live_settings(delay));
    for (int i = 0; i < kPictures; ++i) {
      line.push(clip()[i]);
      EXPECT_GT(static_cast<int>(line.shown.size()), i - delay) << i;
    }
    line.finish();
    EXPECT_EQ(line.shown.size(), std::size_t{kPictures});
  }
}

TEST(Live, ALongDelayTakesFewerBytes) {
  const auto coded = [](int delay) {
    LiveLine line(live_settings(delay));
    for (int i = 0; i < kPictures; ++i) line.push(clip()[i]);
    line.finish();
    return std::pair{line.stream.size(), psnr_of(line.shown)};
  };
  const auto [bytes, psnr] = coded(kGroup);
  const auto [late_bytes, late_psnr] = coded(kPicturesPerSecond);
  EXPECT_LT(static_cast<double>(late_bytes), 0.85 * static_cast<double>(bytes));
  EXPECT_GT(late_psnr, psnr - 0.3);
}

TEST(Live, PicturesAreFit) {
  LiveLine line;
  for (int i = 0; i < kPictures; ++i) line.push(clip()[i]);
  line.finish();
  EXPECT_GT(psnr_of(line.shown), 27);
}

TEST(Live, APictureThatStaysGetsOneFinerPatternAfterTwoSeconds) {
  LiveLine line;
  const auto error = [&] { return squared_error(line.shown.back().y, clip()[0].y).psnr(); };
  for (int i = 0; i < 2 * kPicturesPerSecond; ++i) line.push(clip()[0]);
  EXPECT_EQ(line.patterns, 1U);
  const double before = error();
  for (int i = 0; i < 2 * kGroup; ++i) line.push(clip()[0]);
  EXPECT_EQ(line.patterns, 2U);
  EXPECT_GT(error(), before + 0.5);
  for (int i = 0; i < 4 * kPicturesPerSecond; ++i) line.push(clip()[0]);
  EXPECT_EQ(line.patterns, 2U);
}

TEST(Live, APictureThatStaysGetsNoFinerPatternInWindows) {
  LiveLine line(live_settings(kPicturesPerSecond));
  for (int i = 0; i < 6 * kPicturesPerSecond; ++i) line.push(clip()[0]);
  EXPECT_EQ(line.patterns, 1U);
}

// The room changes as much as by a cut, but without one: the light of half of it changes.
TEST(Live, AChangeIsSentWithItsGroup) {
  Picture changed = clip()[0];
  for (int y = 0; y < changed.height(); ++y)
    for (int x = 0; x < changed.width() / 4; ++x) changed.y.row(y)[x] = static_cast<std::uint8_t>(x + y);
  LiveLine line;
  for (int i = 0; i < 3 * kGroup + 1; ++i) line.push(clip()[0]);
  const auto error = [&] { return squared_error(line.shown.back().y, changed.y).psnr(); };
  ASSERT_LT(error(), 20);
  for (int i = 0; i < 2 * kGroup; ++i) line.push(changed);
  EXPECT_EQ(line.patterns, 2U);
  EXPECT_GT(error(), 25);
}

/// Pictures with which scenes begin.
std::vector<std::uint64_t> scene_begins(const std::vector<std::uint8_t>& stream) {
  std::vector<std::uint64_t> out;
  for (const SceneEntry& scene : index_scenes(stream)) out.push_back(scene.before.pictures);
  return out;
}

/// @param requests  pictures before which a scene is asked for
std::vector<std::uint8_t> encoded(EncoderSettings settings, int threads,
                                  const std::vector<int>& requests = {}) {
  settings.threads = threads;
  auto encoder = Encoder::create(clip().format(), settings);
  EXPECT_TRUE(encoder);
  std::vector<std::uint8_t> stream;
  const auto take = [&] {
    const auto bytes = encoder->take();
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  };
  for (int i = 0; i < kPictures; ++i) {
    if (std::ranges::find(requests, i) != requests.end()) {
      EXPECT_TRUE(encoder->request_scene());
    }
    EXPECT_TRUE(encoder->push(clip()[i]));
    take();
  }
  EXPECT_TRUE(encoder->finish());
  take();
  return stream;
}

TEST(Live, ASceneBeginsOnRequestAfterTheGroup) {
  EncoderSettings settings = live_settings();
  for (const int patterns : {0, 1}) {
    settings.patterns = patterns;
    for (const int threads : {1, 2}) {
      EXPECT_EQ(scene_begins(encoded(settings, threads)).size(), 1U);
      // The first picture is a group of its own. Whoever asks twice gets one.
      const auto begins = scene_begins(encoded(settings, threads, {10, 11, 30}));
      ASSERT_EQ(begins.size(), 3U) << patterns << " patterns, " << threads << " threads";
      EXPECT_GE(begins[1], 10U);
      EXPECT_LE(begins[1], 10U + kGroup);
      EXPECT_GE(begins[2], 30U);
      EXPECT_LE(begins[2], 30U + kGroup);
    }
  }
}

TEST(Live, StreamsWithRequestsDecodeWhole) {
  LiveLine line;
  for (int i = 0; i < kPictures; ++i) {
    if (i % 7 == 3) line.request_scene();
    line.push(clip()[i]);
    EXPECT_GT(static_cast<int>(line.shown.size()), i - kGroup) << i;
  }
  line.finish();
  ASSERT_EQ(line.shown.size(), std::size_t{kPictures});
  EXPECT_GT(psnr_of(line.shown), 27);
}

/// Whether each pattern behind the first needs that alone.
std::vector<bool> alone_in(std::span<const std::uint8_t> stream) {
  PacketReader packets(stream);
  SceneReader reader;
  std::vector<bool> out;
  for (auto read = packets.next(); read && read->status == ReadStatus::kPacket; read = packets.next()) {
    const auto syntax = reader.read(read->packet);
    EXPECT_TRUE(syntax);
    while (reader.pictures().has_next()) (void)reader.pictures().next();
    if (const auto* const patterns = std::get_if<std::vector<ScenePattern>>(&*syntax))
      if (!patterns->front().is_first()) out.push_back(patterns->front().coded.alone);
  }
  return out;
}

TEST(Live, PatternsBehindALostOneNeedTheHeadAlone) {
  EncoderSettings settings = live_settings();
  settings.quality = 90;  // more patterns
  settings.live->resilience = Resilience::kPacket;
  for (const int threads : {1, 2, 3}) {
    settings.threads = threads;
    if (threads == 3) settings.bitrate = 40, settings.start = 0.15;  // the head has a coarse one
    LiveLine line(settings);
    for (int i = 0; i < kPictures; ++i) {
      if (i == kPictures / 2) line.lose_patterns();
      line.push(clip()[i]);
    }
    line.finish();
    const std::vector<bool> alone = alone_in(line.stream);
    EXPECT_TRUE(std::is_sorted(alone.begin(), alone.end()));
    ASSERT_FALSE(alone.empty());
    EXPECT_FALSE(alone.front());
    EXPECT_TRUE(alone.back());
    ASSERT_EQ(line.shown.size(), std::size_t{kPictures});
    EXPECT_GT(psnr_of(line.shown), 27);
  }
  EXPECT_FALSE(Encoder::create(clip().format(), {})->lose_patterns());
}

class LiveStart : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Live, LiveStart, testing::Values(kGroup, 15));

TEST_P(LiveStart, TheFirstPictureIsThereInTimeAndAFinerOneTakesItsPlace) {
  constexpr double kStart = 0.25;
  EncoderSettings settings = live_settings(GetParam());
  settings.bitrate = 20;
  std::vector<std::uint64_t> startup;
  std::vector<double> first, later;
  for (const double start : {0.0, kStart}) {
    settings.start = start;
    LiveLine line(settings);
    for (int i = 0; i < kPictures; ++i) line.push(clip()[i]);
    line.finish();
    startup.push_back(line.bytes.startup);
    first.push_back(squared_error(line.shown.front().y, clip()[0].y).psnr());
    later.push_back(squared_error(line.shown.back().y, clip()[kPictures - 1].y).psnr());
  }
  const double in_time = 125 * settings.bitrate * kStart;
  EXPECT_GT(static_cast<double>(startup[0]), in_time);
  EXPECT_LE(static_cast<double>(startup[1]), in_time);
  EXPECT_GT(static_cast<double>(startup[1]), 0.5 * in_time);
  EXPECT_LT(first[1], first[0]);
  EXPECT_GT(later[1], later[0] - 0.5);
}

TEST(Live, AFileHasNoScenesOnRequest) {
  EXPECT_FALSE(Encoder::create(clip().format(), {})->request_scene());
}

TEST(Live, ThreadsChangeNothing) {
  EXPECT_EQ(encoded(live_settings(), 2), encoded(live_settings(), 1));
  EncoderSettings with_keys = live_settings();
  with_keys.key_interval = 1;
  EXPECT_EQ(encoded(with_keys, 2), encoded(with_keys, 1));
  EncoderSettings with_rate = live_settings();
  with_rate.bitrate = 6;
  EXPECT_EQ(encoded(with_rate, 2), encoded(with_rate, 1));
  with_rate.live->delay = 1;
  EXPECT_EQ(encoded(with_rate, 3), encoded(with_rate, 1));
}

TEST(Live, BytesBecomeReadyWithoutAnotherPicture) {
  EncoderSettings settings = live_settings();
  settings.threads = 2;
  auto encoder = Encoder::create(clip().format(), settings);
  ASSERT_TRUE(encoder);
  const auto until = std::chrono::steady_clock::now() + std::chrono::minutes(10);
  EXPECT_EQ(encoder->take().size(), kSignature.size());
  EXPECT_FALSE(encoder->wait(until)) << "nothing is being coded";
  for (int i = 0; i < 5 * kGroup + 1; ++i) {
    ASSERT_TRUE(encoder->push(clip()[i]));
    EXPECT_EQ(encoder->wait(until), i % kGroup == 0) << "picture " << i;
    while (encoder->is_coding()) std::this_thread::yield();
    EXPECT_EQ(encoder->take().empty(), i % kGroup != 0) << "picture " << i;
  }
}

class LiveDelay : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Live, LiveDelay, testing::Values(kGroup, 15));

TEST_P(LiveDelay, ViewersCanJoin) {
  EncoderSettings settings = live_settings(GetParam());
  settings.key_interval = 1;
  auto encoder = Encoder::create(clip().format(), settings);
  ASSERT_TRUE(encoder);
  for (int i = 0; i < kPictures; ++i) ASSERT_TRUE(encoder->push(clip()[i]));
  ASSERT_TRUE(encoder->finish());
  StreamDecoder decoder;
  decoder.feed(encoder->take());
  decoder.close();
  std::vector<std::uint64_t> scenes;
  for (;;) {
    const auto status = decoder.next();
    ASSERT_TRUE(status) << status.error().text;
    if (*status != DecodeStatus::kPicture) break;
    const std::uint64_t first = decoder.scene().setup.before.pictures;
    if (scenes.empty() || scenes.back() != first) scenes.push_back(first);
  }
  ASSERT_GE(scenes.size(), 3U);
  for (std::size_t i = 1; i < scenes.size(); ++i) EXPECT_LE(scenes[i] - scenes[i - 1], 20U);
}

}  // namespace
}  // namespace fbs
