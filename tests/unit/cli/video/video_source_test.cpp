#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <vector>

#include "cli/video/open/open_video.h"
#include "cli/video/timestamps.h"

namespace fbs {
namespace {

namespace fs = std::filesystem;

class VideoSourceFiles : public ::testing::Test {
 protected:
  VideoSourceFiles() { fs::create_directories(folder_); }
  ~VideoSourceFiles() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("fbs_video_source_test_" + std::to_string(getpid()));
};

/// A soft ramp that moves by two pixels a picture.
Picture moving_ramp(int width, int height, int number) {
  Picture picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      picture.y.row(y)[x] = static_cast<std::uint8_t>(60 + (x + y + 2 * number) % 128);
    }
  }
  for (int y = 0; y < picture.u.height; ++y) {
    for (int x = 0; x < picture.u.width; ++x) {
      picture.u.row(y)[x] = static_cast<std::uint8_t>(120 + x % 16);
      picture.v.row(y)[x] = static_cast<std::uint8_t>(120 + y % 16);
    }
  }
  return picture;
}

void write_video(const std::string& name, const VideoFormat& format, const std::vector<std::int64_t>& times) {
  auto sink = open_video_sink(name, format);
  ASSERT_TRUE(sink) << sink.error().text;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto written =
        (*sink)->write(moving_ramp(format.width, format.height, static_cast<int>(i)), times[i]);
    ASSERT_TRUE(written) << written.error().text;
  }
  const auto finished = (*sink)->finish();
  ASSERT_TRUE(finished) << finished.error().text;
}

std::vector<std::int64_t> regular_times(int count, Rational rate) {
  std::vector<std::int64_t> times;
  for (int i = 0; i < count; ++i) times.push_back(regular_pts(i, rate));
  return times;
}

std::vector<TimedPicture> read_all(VideoSource& source) {
  std::vector<TimedPicture> pictures;
  for (;;) {
    auto timed = source.next();
    EXPECT_TRUE(timed) << timed.error().text;
    if (!timed || !*timed) return pictures;
    pictures.push_back(std::move(**timed));
  }
}

double mean_difference(const Plane& a, const Plane& b) {
  EXPECT_EQ(a.samples.size(), b.samples.size());
  double sum = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) sum += std::abs(a.samples[i] - b.samples[i]);
  return sum / static_cast<double>(a.samples.size());
}

struct Kind {
  const char* name;
  VideoFormat format;
};

class VideoSourceOfEachKind : public VideoSourceFiles, public ::testing::WithParamInterface<Kind> {};

TEST_P(VideoSourceOfEachKind, ReadsBackCountSizeRateTimesAndColour) {
  const auto& [name, format] = GetParam();
  const std::vector<std::int64_t> times = regular_times(40, format.frame_rate);
  ASSERT_NO_FATAL_FAILURE(write_video(path(name), format, times));

  auto source = open_video_source(path(name));
  ASSERT_TRUE(source) << source.error().text;
  EXPECT_EQ((*source)->format().width, format.width);
  EXPECT_EQ((*source)->format().height, format.height);
  EXPECT_EQ((*source)->format().frame_rate, format.frame_rate);
  EXPECT_EQ((*source)->format().pixel_aspect, format.pixel_aspect);
  EXPECT_EQ((*source)->format().range, format.range);
  EXPECT_EQ((*source)->format().matrix, format.matrix);
  EXPECT_NEAR(static_cast<double>((*source)->frame_count_estimate().value_or(0)), 40, 1);
  const double period = static_cast<double>(format.frame_rate.den) / format.frame_rate.num;
  EXPECT_NEAR((*source)->seconds_estimate().value_or(0), 40 * period, period);

  const std::vector<TimedPicture> pictures = read_all(**source);
  ASSERT_EQ(pictures.size(), 40U);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    EXPECT_EQ(pictures[i].pts, times[i]);
    const Picture expected = moving_ramp(format.width, format.height, static_cast<int>(i));
    EXPECT_LT(mean_difference(pictures[i].picture.y, expected.y), 2);
    EXPECT_LT(mean_difference(pictures[i].picture.u, expected.u), 2);
    EXPECT_LT(mean_difference(pictures[i].picture.v, expected.v), 2);
  }
}

constexpr Rational kNtsc{30000, 1001};
INSTANTIATE_TEST_SUITE_P(
    Files, VideoSourceOfEachKind,
    ::testing::Values(
        Kind{"a.mp4", {96, 64, {25, 1}, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt601}},
        Kind{"a.mkv", {96, 64, {25, 1}, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt709}},
        Kind{"ntsc.mp4", {96, 64, kNtsc, {128, 117}, ColourRange::kFull, ColourMatrix::kBt709}},
        Kind{"ntsc.mkv", {96, 64, kNtsc, {128, 117}, ColourRange::kFull, ColourMatrix::kUnspecified}},
        Kind{"film.mp4", {96, 64, {24000, 1001}, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt601}},
        Kind{"odd.mp4", {97, 67, {30, 1}, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt601}},
        Kind{"odd.mkv", {65, 64, {12000, 1001}, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt601}}),
    [](const auto& instance) {
      std::string name = instance.param.name;
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

TEST_F(VideoSourceFiles, VariableFrameRateKeepsItsTimes) {
  const VideoFormat format{96, 64, {25, 1}, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt601};
  std::vector<std::int64_t> times;
  std::int64_t time = 0;
  for (int i = 0; i < 50; ++i) {
    times.push_back(time);
    time += 1800 + 97 * (i * i % 41);
  }
  // Matroska rounds to 1 ms; times within 1 ms of the regular grid are moved onto it.
  for (const auto& [name, tolerance] : {std::pair{"a.mp4", 0}, std::pair{"a.mkv", 135}}) {
    ASSERT_NO_FATAL_FAILURE(write_video(path(name), format, times));
    auto source = open_video_source(path(name));
    ASSERT_TRUE(source) << source.error().text;
    const std::vector<TimedPicture> pictures = read_all(**source);
    ASSERT_EQ(pictures.size(), times.size());
    std::int64_t before = std::numeric_limits<std::int64_t>::min();
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_GT(pictures[i].pts, before);
      EXPECT_NEAR(static_cast<double>(pictures[i].pts), static_cast<double>(times[i]), tolerance)
          << name << i;
      before = pictures[i].pts;
    }
  }
}

TEST_F(VideoSourceFiles, ImageSequenceRoundTrips) {
  for (const auto& [width, height] : {std::pair{96, 64}, std::pair{97, 65}}) {
    const VideoFormat format{width, height, {25, 1}, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt601};
    ASSERT_NO_FATAL_FAILURE(write_video(path("f_%05d.png"), format, regular_times(12, {25, 1})));
    EXPECT_TRUE(fs::exists(path("f_00001.png")));
    EXPECT_TRUE(fs::exists(path("f_00012.png")));
    for (const std::string& input : {path("f_%05d.png"), path("f_*.png"), path("")}) {
      auto source = open_video_source(input);
      ASSERT_TRUE(source) << source.error().text;
      EXPECT_EQ((*source)->format(), format);
      EXPECT_EQ((*source)->frame_count_estimate(), 12);
      const std::vector<TimedPicture> pictures = read_all(**source);
      ASSERT_EQ(pictures.size(), 12U);
      for (int i = 0; i < 12; ++i) {
        const TimedPicture& timed = pictures[i];
        const Picture expected = moving_ramp(width, height, i);
        EXPECT_EQ(timed.pts, i * 3600);
        EXPECT_LT(mean_difference(timed.picture.y, expected.y), 1);
        EXPECT_LT(mean_difference(timed.picture.u, expected.u), 1);
        EXPECT_LT(mean_difference(timed.picture.v, expected.v), 1);
      }
    }
  }
}

TEST_F(VideoSourceFiles, ImageOfAnotherSizeIsAnErrorNamingIt) {
  const VideoFormat small{96, 64, {25, 1}, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt601};
  const VideoFormat large{98, 64, {25, 1}, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt601};
  ASSERT_NO_FATAL_FAILURE(write_video(path("b_%d.png"), large, {0}));
  ASSERT_NO_FATAL_FAILURE(write_video(path("a_%d.png"), small, {0}));
  auto source = open_video_source(path("*.png"));
  ASSERT_TRUE(source) << source.error().text;
  ASSERT_TRUE((*source)->next());
  const auto second = (*source)->next();
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(second.error().text.find("b_1.png"), std::string::npos) << second.error().text;
}

TEST_F(VideoSourceFiles, MissingInputIsAnErrorNamingItAndTheCause) {
  for (const char* name : {"none.y4m", "none.mkv", "none_%05d.png", "none/*.png"}) {
    const auto source = open_video_source(path(name));
    ASSERT_FALSE(source) << name;
    EXPECT_EQ(source.error().code, ErrorCode::kIo);
    EXPECT_NE(source.error().text.find(path(name)), std::string::npos) << source.error().text;
  }
}

TEST_F(VideoSourceFiles, FileOfAnotherKindIsAnErrorNamingIt) {
  std::ofstream(path("letter.mkv")) << "Dear reader, this is not a video.";
  const auto source = open_video_source(path("letter.mkv"));
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(source.error().text.find("letter.mkv"), std::string::npos) << source.error().text;
}

TEST(VideoSource, MissingCameraIsAnError) {
  const auto source = open_video_source("camera:97");
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kIo);
  EXPECT_FALSE(open_video_source("camera:front"));
}

/// A slope of 8 levels over the width, with samples of more than 8 bits: 64 columns a level.
constexpr int kSlopeWidth = 512, kSlopeHeight = 64;

/// @param level_at  the slope at a column, in levels of 8 bits
/// @return the largest difference of a mean over 8 x 8 samples
template <class Function>
double worst_mean(const Plane& plane, Function level_at) {
  double worst = 0;
  for (int y = 0; y < plane.height; y += 8) {
    for (int x = 0; x < plane.width; x += 8) {
      double sum = 0;
      for (int i = 0; i < 64; ++i) sum += plane.row(y + i / 8)[x + i % 8] - level_at(x + i % 8);
      worst = std::max(worst, std::abs(sum / 64));
    }
  }
  return worst;
}

int longest_run(const Plane& plane) {
  int longest = 0, run = 0;
  for (std::size_t i = 1; i < plane.samples.size(); ++i) {
    run = plane.samples[i] == plane.samples[i - 1] ? run + 1 : 0;
    longest = std::max(longest, run + 1);
  }
  return longest;
}

void append(std::string& bytes, unsigned sample, bool low_first) {
  const auto low = static_cast<char>(sample & 255), high = static_cast<char>(sample >> 8);
  bytes += low_first ? low : high;
  bytes += low_first ? high : low;
}

TEST_F(VideoSourceFiles, SlopesOfTenBitsHaveNoBands) {
  const auto level_at = [](int x) { return 100 + x / 16 / 4.0; };
  std::string bytes = "YUV4MPEG2 W512 H64 F25:1 C420p10\nFRAME\n";
  for (int i = 0; i < kSlopeWidth * kSlopeHeight; ++i)
    append(bytes, static_cast<unsigned>(4 * level_at(i % kSlopeWidth)), true);
  for (int i = 0; i < kSlopeWidth * kSlopeHeight / 2; ++i) append(bytes, 512, true);
  for (const char* name : {"slope.y4m", "slope.mkv"}) {  // libav goes by what is inside
    std::ofstream(path(name), std::ios::binary) << bytes;
    const auto source = open_video_source(path(name));
    ASSERT_TRUE(source) << source.error().text;
    const auto pictures = read_all(**source);
    ASSERT_EQ(pictures.size(), 1U);
    EXPECT_LT(worst_mean(pictures[0].picture.y, level_at), 0.02) << name;
    EXPECT_LT(longest_run(pictures[0].picture.y), 60) << name;
    EXPECT_EQ(pictures[0].picture.u, Plane(kSlopeWidth / 2, kSlopeHeight / 2, 128)) << name;
  }
}

TEST_F(VideoSourceFiles, SlopesOfImagesOfSixteenBitsHaveNoBands) {
  std::string bytes = "P6 512 64 65535\n";
  for (int i = 0; i < 3 * kSlopeWidth * kSlopeHeight; ++i)
    append(bytes, static_cast<unsigned>(std::lround(257 * (100 + i / 3 % kSlopeWidth / 64.0))), false);
  for (const auto& [file, input] :
       {std::pair{"slope_1.ppm", "slope_%d.ppm"}, std::pair{"slope.ppm", "slope.ppm"}}) {
    std::ofstream(path(file), std::ios::binary) << bytes;
    const auto source = open_video_source(path(input));  // by OpenImageIO, then by libav
    ASSERT_TRUE(source) << source.error().text;
    const auto pictures = read_all(**source);
    ASSERT_EQ(pictures.size(), 1U);
    const Plane& luma = pictures[0].picture.y;
    EXPECT_LT(worst_mean(luma, [](int x) { return 16 + (100 + x / 64.0) * 219 / 255; }), 0.05) << input;
    EXPECT_LT(longest_run(luma), 60) << input;
    EXPECT_EQ(pictures[0].picture.u, Plane(kSlopeWidth / 2, kSlopeHeight / 2, 128)) << input;
  }
}

}  // namespace
}  // namespace fbs
