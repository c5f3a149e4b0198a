#include <fstream>
#include <iterator>

#include "cli/video/open/open_video.h"
#include "cli/video/timestamps.h"
#include "sound_files.h"

namespace fbs {
namespace {

constexpr std::size_t kPacketBytes = 60;  // 24 kbit/s in frames of 20 ms
constexpr int kSkip = 312;                // of libopus
constexpr int kSeconds = 6;

VideoFormat format_at(Rational rate) {
  return {96, 64, rate, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt601};
}

SoundSetup opus() {
  SoundSetup setup;
  setup.skip = kSkip;
  return setup;
}

std::vector<std::int64_t> regular_times(Rational rate) {
  std::vector<std::int64_t> times;
  for (std::int64_t i = 0; regular_pts(i, rate) < kSeconds * kTicksPerSecond; ++i)
    times.push_back(regular_pts(i, rate));
  return times;
}

std::vector<std::int64_t> irregular_times() {
  std::vector<std::int64_t> times{0};
  while (times.back() < kSeconds * kTicksPerSecond)
    times.push_back(times.back() + 900 + 1300 * static_cast<std::int64_t>(times.size() % 7));
  return times;
}

class SoundSinkFiles : public SoundFiles {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(write_bursts("tone.wav", 48000, kSeconds));
    // At a constant rate all packets have one size, and the file of them needs no index.
    ASSERT_NO_FATAL_FAILURE(ffmpeg("-i tone.wav -c:a libopus -b:a 24k -vbr off tone.opus"));
    ASSERT_NO_FATAL_FAILURE(ffmpeg("-i tone.opus -map 0:a -c copy -f data packets.bin"));
    std::ifstream file(path("packets.bin"), std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    ASSERT_EQ(bytes.size() % kPacketBytes, 0U);
    for (std::size_t i = 0; i < bytes.size(); i += kPacketBytes)
      packets_.emplace_back(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                            bytes.begin() + static_cast<std::ptrdiff_t>(i + kPacketBytes));
    ASSERT_GT(packets_.size(), 290U);
  }

  void write(const std::string& name, Rational rate, const std::vector<std::int64_t>& times) const {
    auto sink = open_video_sink(path(name), format_at(rate), {.sound = opus()});
    ASSERT_TRUE(sink) << sink.error().text;
    std::size_t next = 0;
    for (const std::int64_t time : times) {
      for (; next < packets_.size() && begin_of(next) * kTicksPerSecond < time * kSoundClock; ++next) {
        const auto written = (*sink)->write_sound(packets_[next], begin_of(next));
        ASSERT_TRUE(written) << written.error().text;
      }
      ASSERT_TRUE((*sink)->write(Picture(96, 64), time));
    }
    const auto finished = (*sink)->finish();
    ASSERT_TRUE(finished) << finished.error().text;
  }

  static std::int64_t begin_of(std::size_t packet) { return static_cast<std::int64_t>(packet) * 960 - kSkip; }

  /// Heard by ffmpeg: with the silence before it that its timestamps ask for.
  [[nodiscard]] std::vector<double> onsets_by_ffmpeg(const std::string& name) const {
    ffmpeg("-i " + name + " -map 0:a -af aresample=async=1:first_pts=0 -ar 48000 -ac 1 heard.wav");
    return burst_onsets(read("heard.wav"), 48000);
  }

  /// Seconds from the start of the container, which is where ffmpeg counts from.
  [[nodiscard]] double first_picture(const std::string& name) const {
    auto source = open_video_source(path(name));
    EXPECT_TRUE(source) << source.error().text;
    if (!source) return -1;
    auto picture = (*source)->next();
    EXPECT_TRUE(picture && *picture);
    return picture && *picture ? static_cast<double>((*picture)->pts) / kTicksPerSecond : -1;
  }

  /// Checks with our reader, and with ffmpeg's as a second opinion.
  void expect_in_step(const std::string& name) const {
    const auto ours = burst_onsets(read(name), 48000);
    const auto theirs = onsets_by_ffmpeg(name);
    const double start = first_picture(name);
    ASSERT_EQ(std::ssize(ours), kSeconds) << name;
    ASSERT_EQ(std::ssize(theirs), kSeconds) << name;
    for (std::size_t i = 0; i < kSeconds; ++i) {
      EXPECT_NEAR(ours[i], burst_time(static_cast<int>(i)), 0.002) << name;
      EXPECT_NEAR(theirs[i] - start, burst_time(static_cast<int>(i)), 0.002) << name;
    }
  }

  std::vector<std::vector<std::uint8_t>> packets_;
};

TEST_F(SoundSinkFiles, SoundIsInStepAtEveryPictureRate) {
  for (const char* name : {"a.mp4", "a.mkv"}) {
    for (const Rational rate : {Rational{25, 1}, Rational{30000, 1001}}) {
      ASSERT_NO_FATAL_FAILURE(write(name, rate, regular_times(rate)));
      expect_in_step(name);
    }
    ASSERT_NO_FATAL_FAILURE(write(name, {20, 1}, irregular_times()));
    expect_in_step(name);
  }
}

TEST_F(SoundSinkFiles, PacketsAreNotEncodedAgain) {
  for (const char* name : {"a.mp4", "a.mkv"}) {
    ASSERT_NO_FATAL_FAILURE(write(name, {25, 1}, regular_times({25, 1})));
    ffmpeg("-i " + std::string(name) + " -map 0:a -c copy -f data copy.bin");
    std::ifstream file(path("copy.bin"), std::ios::binary);
    const std::vector<std::uint8_t> copy{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::uint8_t> all;
    for (const auto& packet : packets_) all.insert(all.end(), packet.begin(), packet.end());
    all.resize(std::min(all.size(), copy.size()));  // the last ones begin after the last picture
    EXPECT_GT(copy.size(), kPacketBytes * 290);
    EXPECT_EQ(copy, all) << name;
  }
}

TEST_F(SoundSinkFiles, ContainersSayWhatPlayersLeaveOut) {
  const auto contains = [&](const char* name, const std::string& bytes) {
    std::ifstream file(path(name), std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    return content.find(bytes) != std::string::npos;
  };
  using namespace std::string_literals;
  for (const char* name : {"a.mp4", "a.mkv"})
    ASSERT_NO_FATAL_FAILURE(write(name, {25, 1}, regular_times({25, 1})));
  // CodecDelay of 6500000 ns, SeekPreRoll of 80 ms, and OpusHead.
  EXPECT_TRUE(contains("a.mkv", "\x56\xAA\x83\x63\x2E\xA0"s));
  EXPECT_TRUE(contains("a.mkv", "\x56\xBB\x84\x04\xC4\xB4\x00"s));
  EXPECT_TRUE(contains("a.mkv", "OpusHead\1\1\x38\1\x80\xBB\0\0\0\0\0"s));
  // OpusSpecificBox, and an edit that begins at sample 312.
  EXPECT_TRUE(contains("a.mp4", "dOps\0\1\1\x38\0\0\xBB\x80\0\0\0"s));
  EXPECT_TRUE(contains("a.mp4", "\0\0\1\x38\0\1\0\0"s));
}

TEST_F(SoundSinkFiles, LostFramesMoveNothing) {
  for (int i = 60; i < 110; ++i) packets_[static_cast<std::size_t>(i)].clear();  // 1.2 s to 2.2 s
  for (const char* name : {"a.mp4", "a.mkv"}) {
    ASSERT_NO_FATAL_FAILURE(write(name, {25, 1}, regular_times({25, 1})));
    const auto onsets = burst_onsets(read(name), 48000);
    EXPECT_EQ(onsets.size(), 5U) << name;  // without the one at 1.285 s
    for (int i : {0, 2, 3, 4, 5}) EXPECT_NEAR(burst_lag(onsets, burst_time(i)), 0, 0.002) << name << i;
  }
}

TEST_F(SoundSinkFiles, SoundIsRefusedWhereItHasNoPlace) {
  for (const char* name : {"a.y4m", "a_%03d.png"}) {
    const auto sink = open_video_sink(path(name), format_at({25, 1}), {.sound = opus()});
    ASSERT_FALSE(sink) << name;
    EXPECT_EQ(sink.error().code, ErrorCode::kUnsupported);
    EXPECT_NE(sink.error().text.find(name), std::string::npos) << sink.error().text;
  }
  for (const char* name : {"null:", "-"})
    EXPECT_FALSE(open_video_sink(name, format_at({25, 1}), {.sound = opus()}));
  auto silent = open_video_sink(path("a.mp4"), format_at({25, 1}));
  ASSERT_TRUE(silent);
  const auto written = (*silent)->write_sound(packets_[0], -kSkip);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kUnsupported);
}

TEST_F(SoundSinkFiles, OtherSoundsThanOneOfOpusAreRefused) {
  const auto refused = [&](const SinkOptions& options, const std::string& text) {
    const auto sink = open_video_sink(path("a.mkv"), format_at({25, 1}), options);
    ASSERT_FALSE(sink);
    EXPECT_NE(sink.error().text.find(text), std::string::npos) << sink.error().text;
  };
  SoundSetup setup = opus();
  setup.codec = SoundCodec::kCodec2;
  refused({.sound = setup}, "must be Opus");
  setup = opus();
  setup.skip = 65536;
  refused({.sound = setup}, "65536/48000 s early");
  refused({.sound_source = path("tone.wav"), .sound = opus()}, "one sound, not two");
}

TEST_F(SoundSinkFiles, CopiedSoundCountsFromTheFirstPictureOfItsSource) {
  ffmpeg(
      "-itsoffset 0.5 -f lavfi -i testsrc=s=128x96:r=50:d=6 -i tone.wav -fps_mode passthrough -c:v mpeg4 "
      "-c:a flac early.mkv");
  auto sink = open_video_sink(path("a.mkv"), format_at({25, 1}), {.sound_source = path("early.mkv")});
  ASSERT_TRUE(sink) << sink.error().text;
  for (const std::int64_t time : regular_times({25, 1})) ASSERT_TRUE((*sink)->write(Picture(96, 64), time));
  ASSERT_TRUE((*sink)->finish());
  expect_bursts("a.mkv", 1, 5, -0.5);
}

}  // namespace
}  // namespace fbs
