#include "cli/video/y4m/y4m.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <vector>

namespace fbs {
namespace {

namespace fs = std::filesystem;

class Y4m : public ::testing::Test {
 protected:
  Y4m() { fs::create_directories(folder_); }
  ~Y4m() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  [[nodiscard]] std::string store(const std::string& bytes) const {
    std::ofstream(path("given.y4m"), std::ios::binary) << bytes;
    return path("given.y4m");
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("fbs_y4m_test_" + std::to_string(getpid()));
};

Picture numbered_picture(int width, int height, int number) {
  Picture picture(width, height);
  auto value = static_cast<unsigned>(number);
  for (Plane* plane : {&picture.y, &picture.u, &picture.v}) {
    for (std::uint8_t& sample : plane->samples) sample = static_cast<std::uint8_t>(value = value * 5 + 3);
  }
  return picture;
}

/// A Y4M file in memory with one picture of the given planes.
std::string one_picture(const std::string& chroma, const std::string& planes) {
  return "YUV4MPEG2 W64 H64 F25:1 C" + chroma + "\nFRAME\n" + planes;
}

TEST_F(Y4m, RoundTripsPicturesAndFormat) {
  for (const auto& [width, height] :
       {std::pair{64, 64}, std::pair{65, 66}, std::pair{66, 65}, std::pair{97, 71}}) {
    const VideoFormat format{
        width, height, {30000, 1001}, {128, 117}, ColourRange::kFull, ColourMatrix::kBt709};
    auto sink = open_y4m_sink(path("a.y4m"), format);
    ASSERT_TRUE(sink) << sink.error().text;
    for (int i = 0; i < 3; ++i) ASSERT_TRUE((*sink)->write(numbered_picture(width, height, i), i * 3003));
    ASSERT_TRUE((*sink)->finish());

    auto source = open_y4m_source(path("a.y4m"));
    ASSERT_TRUE(source) << source.error().text;
    EXPECT_EQ((*source)->format(), format);
    EXPECT_EQ((*source)->frame_count_estimate(), 3);
    for (int i = 0; i < 3; ++i) {
      const auto timed = (*source)->next();
      ASSERT_TRUE(timed && *timed);
      EXPECT_EQ((*timed)->picture, numbered_picture(width, height, i));
      EXPECT_EQ((*timed)->pts, i * 3003);
    }
    EXPECT_EQ((*source)->next().value(), std::nullopt);
    EXPECT_EQ((*source)->next().value(), std::nullopt);
  }
}

TEST_F(Y4m, DamagedHeaderIsAnErrorNamingTheFile) {
  for (const char* header :
       {"", "YUV4MPEG3 W64 H64\n", "YUV4MPEG2\n", "YUV4MPEG2 W64\n", "YUV4MPEG2 Wx H64\n",
        "YUV4MPEG2 W64 H-64\n", "YUV4MPEG2 W64 H64 F25\n", "YUV4MPEG2 W64 H64 F1:4294967295\n",
        "YUV4MPEG2 W64 H64 C999\n", "YUV4MPEG2 W64 H64 C420p99\n", "YUV4MPEG2 W99999999999999 H64\n",
        "YUV4MPEG2 W16 H64\n", "YUV4MPEG2 W64 H100000\n", "YUV4MPEG2 W64 H64"}) {
    const auto source = open_y4m_source(store(header));
    ASSERT_FALSE(source) << header;
    EXPECT_NE(source.error().text.find("given.y4m"), std::string::npos) << source.error().text;
  }
}

TEST_F(Y4m, EndlessHeaderIsAnError) {
  const auto source = open_y4m_source(store("YUV4MPEG2 W64 H64 X" + std::string(100000, 'x')));
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kInvalidStream);
}

TEST_F(Y4m, TruncatedLastPictureIsAnError) {
  const std::string whole = one_picture("420", std::string(64 * 64 * 3 / 2, 'a'));
  for (const std::size_t missing :
       {1U, 1024U, 64U * 64 * 3 / 2, 64U * 64 * 3 / 2 + 1, 64U * 64 * 3 / 2 + 4}) {
    auto source = open_y4m_source(store(whole.substr(0, whole.size() - missing)));
    ASSERT_TRUE(source);
    const auto picture = (*source)->next();
    ASSERT_FALSE(picture) << missing;
    EXPECT_EQ(picture.error().code, ErrorCode::kTruncated);
  }
}

TEST_F(Y4m, MissingFrameLineIsAnError) {
  auto source = open_y4m_source(store("YUV4MPEG2 W64 H64\nFRAMES\n" + std::string(64 * 64 * 3 / 2, 'a')));
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->next().error().code, ErrorCode::kInvalidStream);
}

TEST_F(Y4m, FrameLinesMayCarryParameters) {
  auto source =
      open_y4m_source(store("YUV4MPEG2 W64 H64\nFRAME Ip Xa\n" + std::string(64 * 64 * 3 / 2, 'a')));
  ASSERT_TRUE(source);
  const auto picture = (*source)->next();
  ASSERT_TRUE(picture && *picture);
  EXPECT_EQ((*picture)->picture.y, Plane(64, 64, 'a'));
}

TEST_F(Y4m, MissingFileIsAnErrorNamingItAndTheCause) {
  const auto source = open_y4m_source(path("none.y4m"));
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kIo);
  EXPECT_NE(source.error().text.find("none.y4m"), std::string::npos);
  EXPECT_NE(source.error().text.find("No such file"), std::string::npos);
}

TEST_F(Y4m, MonoGetsGreyChroma) {
  auto source = open_y4m_source(store(one_picture("mono", std::string(64 * 64, 'm'))));
  ASSERT_TRUE(source);
  const auto timed = (*source)->next();
  ASSERT_TRUE(timed && *timed);
  EXPECT_EQ((*timed)->picture.y, Plane(64, 64, 'm'));
  EXPECT_EQ((*timed)->picture.u, Plane(32, 32, 128));
}

TEST_F(Y4m, FullChromaIsAveraged) {
  std::string chroma;
  for (int i = 0; i < 64 * 64; ++i) chroma += static_cast<char>(i % 2 == 0 ? 100 : 103);
  const std::string planes = std::string(64 * 64, 'y') + chroma + std::string(64 * 64, 'v');
  for (const char* kind : {"444", "444alpha"}) {
    const bool alpha = std::string(kind) == "444alpha";
    auto source =
        open_y4m_source(store(one_picture(kind, planes + (alpha ? std::string(64 * 64, 'a') : ""))));
    ASSERT_TRUE(source);
    const auto timed = (*source)->next();
    ASSERT_TRUE(timed && *timed);
    EXPECT_EQ((*timed)->picture.y, Plane(64, 64, 'y'));
    EXPECT_EQ((*timed)->picture.u, Plane(32, 32, 102));  // 101.5 rounded up
    EXPECT_EQ((*timed)->picture.v, Plane(32, 32, 'v'));
    EXPECT_EQ((*source)->next().value(), std::nullopt);
  }
}

TEST_F(Y4m, OtherSubsamplingsKeepAnEvenColour) {
  for (const char* kind : {"422", "411"}) {
    const std::size_t chroma = std::string(kind) == "422" ? 32 * 64 : 16 * 64;
    auto source = open_y4m_source(store(
        one_picture(kind, std::string(64 * 64, 'y') + std::string(chroma, 'u') + std::string(chroma, 'v'))));
    ASSERT_TRUE(source);
    const auto timed = (*source)->next();
    ASSERT_TRUE(timed && *timed);
    EXPECT_EQ((*timed)->picture.u, Plane(32, 32, 'u'));
    EXPECT_EQ((*timed)->picture.v, Plane(32, 32, 'v'));
  }
}

TEST_F(Y4m, TenBitsAreRoundedToEight) {
  std::string planes;
  for (int i = 0; i < 64 * 64 * 3 / 2; ++i)
    planes += std::string("\xff\x03", 2);                    // 1023: rounds to 256, clipped
  planes.replace(0, 4, std::string("\x05\x01\x06\x01", 4));  // 261 -> 65, 262 -> 66
  auto source = open_y4m_source(store(one_picture("420p10", planes)));
  ASSERT_TRUE(source);
  const auto timed = (*source)->next();
  ASSERT_TRUE(timed && *timed);
  EXPECT_EQ((*timed)->picture.y.samples[0], 65);
  EXPECT_EQ((*timed)->picture.y.samples[1], 66);
  EXPECT_EQ((*timed)->picture.y.samples[2], 255);
  EXPECT_EQ((*timed)->picture.v, Plane(32, 32, 255));
}

}  // namespace
}  // namespace fbs
