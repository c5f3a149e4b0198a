#include "cli/video/wav_sink.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace fbs {
namespace {

namespace fs = std::filesystem;

class WavSinkFiles : public ::testing::Test {
 protected:
  WavSinkFiles() { fs::create_directories(folder_); }
  ~WavSinkFiles() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] bool folder_is_empty() const { return fs::is_empty(folder_); }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("fbs_wav_sink_test_" + std::to_string(getpid()));
};

std::vector<std::uint8_t> content(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

constexpr std::array<std::int16_t, 4> kSamples{1, -2, 32767, -32768};

/// A file of two stereo frames at 44100 Hz.
std::vector<std::uint8_t> expected_file() {
  return {'R', 'I', 'F', 'F', 44, 0, 0,    0,    'W', 'A', 'V',  'E',  'f',  'm',  't', ' ', 16, 0,
          0,   0,   1,   0,   2,  0, 0x44, 0xAC, 0,   0,   0x10, 0xB1, 2,    0,    4,   0,   16, 0,
          'd', 'a', 't', 'a', 8,  0, 0,    0,    1,   0,   0xFE, 0xFF, 0xFF, 0x7F, 0,   0x80};
}

TEST_F(WavSinkFiles, HeaderAndSamplesAreLittleEndian) {
  auto sink = WavSink::create(path("a.wav"), 44100, 2);
  ASSERT_TRUE(sink) << sink.error().text;
  ASSERT_TRUE((*sink)->write(std::span(kSamples).first(2)));
  ASSERT_TRUE((*sink)->write(std::span(kSamples).last(2)));
  EXPECT_FALSE(fs::exists(path("a.wav")));
  ASSERT_TRUE((*sink)->finish());
  EXPECT_EQ(content(path("a.wav")), expected_file());
}

TEST_F(WavSinkFiles, PipeGetsTheSamplesAndNoSizes) {
  ASSERT_EQ(mkfifo(path("pipe.wav").c_str(), 0600), 0);
  // Opened for both, it waits for nobody.
  std::fstream held(path("pipe.wav"), std::ios::in | std::ios::out | std::ios::binary);
  {
    auto sink = WavSink::create(path("pipe.wav"), 44100, 2);
    ASSERT_TRUE(sink) << sink.error().text;
    ASSERT_TRUE((*sink)->write(kSamples));
    ASSERT_TRUE((*sink)->finish());
  }
  std::vector<std::uint8_t> expected = expected_file();
  std::fill_n(expected.begin() + 4, 4, 0xFF);
  std::fill_n(expected.begin() + 40, 4, 0xFF);
  std::vector<std::uint8_t> got(expected.size());
  held.read(reinterpret_cast<char*>(got.data()), static_cast<std::streamsize>(got.size()));
  EXPECT_EQ(got, expected);
}

TEST_F(WavSinkFiles, LeaveNothingWithoutFinish) {
  {
    auto sink = WavSink::create(path("a.wav"), 48000, 1);
    ASSERT_TRUE(sink);
    ASSERT_TRUE((*sink)->write(kSamples));
  }
  EXPECT_TRUE(folder_is_empty());
}

TEST_F(WavSinkFiles, UnwritablePathIsAnErrorNamingItAndTheCause) {
  const auto sink = WavSink::create(path("none/a.wav"), 48000, 1);
  ASSERT_FALSE(sink);
  EXPECT_EQ(sink.error().code, ErrorCode::kIo);
  EXPECT_NE(sink.error().text.find("none/a.wav: No such file"), std::string::npos) << sink.error().text;
}

}  // namespace
}  // namespace fbs
