#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "cli/video/open/open_video.h"

namespace fbs {
namespace {

namespace fs = std::filesystem;

const VideoFormat kFormat{96, 64, {25, 1}, {1, 1}, ColourRange::kLimited, ColourMatrix::kBt601};

class VideoSinkFiles : public ::testing::Test {
 protected:
  VideoSinkFiles() { fs::create_directories(folder_); }
  ~VideoSinkFiles() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] bool folder_is_empty() const { return fs::is_empty(folder_); }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("fbs_video_sink_test_" + std::to_string(getpid()));
};

std::string content(const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(VideoSinkFiles, LeaveNothingWithoutFinish) {
  for (const char* name : {"a.y4m", "a.mp4", "a.mkv", "a_%03d.png"}) {
    {
      auto sink = open_video_sink(path(name), kFormat);
      ASSERT_TRUE(sink) << sink.error().text;
      for (int i = 0; i < 5; ++i) ASSERT_TRUE((*sink)->write(Picture(96, 64), i * 3600));
      EXPECT_FALSE(fs::exists(path(name)));
      EXPECT_FALSE(fs::exists(path("a_001.png")));
    }
    EXPECT_TRUE(folder_is_empty()) << name;
  }
}

TEST_F(VideoSinkFiles, StandAloneAfterFinish) {
  for (const char* name : {"a.y4m", "a.mp4", "A.MP4", "a.mkv", "a_%03d.png"}) {
    auto sink = open_video_sink(path(name), kFormat);
    ASSERT_TRUE(sink) << sink.error().text;
    ASSERT_TRUE((*sink)->write(Picture(96, 64), 0));
    ASSERT_TRUE((*sink)->finish());
    sink->reset();
    const std::string only = std::string(name) == "a_%03d.png" ? "a_001.png" : name;
    EXPECT_TRUE(fs::exists(path(only)));
    EXPECT_FALSE(fs::exists(path(only + ".part")));
  }
}

TEST_F(VideoSinkFiles, KeepWhatWasThereWithoutFinish) {
  std::ofstream(path("a.y4m")) << "old";
  {
    auto sink = open_video_sink(path("a.y4m"), kFormat);
    ASSERT_TRUE(sink);
    ASSERT_TRUE((*sink)->write(Picture(96, 64), 0));
  }
  EXPECT_EQ(content(path("a.y4m")), "old");
}

TEST_F(VideoSinkFiles, UnwritablePathIsAnErrorNamingItAndTheCause) {
  for (const char* name : {"none/a.y4m", "none/a.mp4", "none/a.mkv", "none/a_%03d.png"}) {
    const auto sink = open_video_sink(path(name), kFormat);
    ASSERT_FALSE(sink) << name;
    EXPECT_EQ(sink.error().code, ErrorCode::kIo);
    EXPECT_NE(sink.error().text.find(path("none/a")), std::string::npos) << sink.error().text;
    EXPECT_NE(sink.error().text.find("No such file or directory"), std::string::npos) << sink.error().text;
  }
}

TEST_F(VideoSinkFiles, FolderAsOutputIsAnError) {
  fs::create_directories(path("a.y4m"));
  const auto sink = open_video_sink(path("a.y4m"), kFormat);
  ASSERT_FALSE(sink);
  EXPECT_NE(sink.error().text.find("Is a directory"), std::string::npos) << sink.error().text;
}

TEST_F(VideoSinkFiles, FullDiskIsAnErrorNamingTheFileAndTheCause) {
  // /dev/full refuses every byte. Reached through links, so that the names choose the kind of sink.
  for (const char* name : {"full.y4m", "full.mkv", "full.mp4"}) {
    fs::create_symlink("/dev/full", path(name));
    auto sink = open_video_sink(path(name), kFormat);
    Result<void> state;
    if (!sink) state = fail(sink.error());
    for (int i = 0; state && i < 200; ++i) state = (*sink)->write(Picture(96, 64), i * 3600);
    if (state) state = (*sink)->finish();
    ASSERT_FALSE(state) << name;
    EXPECT_EQ(state.error().code, ErrorCode::kIo);
    EXPECT_NE(state.error().text.find(name), std::string::npos) << state.error().text;
    if (std::string(name) == "full.mp4") continue;  // MP4 cannot go to a device at all
    EXPECT_NE(state.error().text.find("No space left on device"), std::string::npos) << state.error().text;
  }
}

TEST_F(VideoSinkFiles, UnknownKindIsAnErrorNamingIt) {
  const auto sink = open_video_sink(path("a.xyz"), kFormat);
  ASSERT_FALSE(sink);
  EXPECT_EQ(sink.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(sink.error().text.find("a.xyz"), std::string::npos);
}

TEST(VideoSink, NullTakesEverything) {
  auto sink = open_video_sink("null:", kFormat);
  ASSERT_TRUE(sink);
  EXPECT_TRUE((*sink)->write(Picture(96, 64), 0));
  EXPECT_TRUE((*sink)->finish());
}

TEST_F(VideoSinkFiles, SoundIsRefusedWhereItHasNoPlace) {
  const auto sink = open_video_sink(path("a.y4m"), kFormat, {.sound_source = path("b.mkv")});
  ASSERT_FALSE(sink);
  EXPECT_EQ(sink.error().code, ErrorCode::kUnsupported);
}

TEST_F(VideoSinkFiles, MissingSoundSourceIsAnErrorAndLeavesNothing) {
  {
    const auto sink = open_video_sink(path("a.mp4"), kFormat, {.sound_source = path("none.mkv")});
    ASSERT_FALSE(sink);
    EXPECT_NE(sink.error().text.find("none.mkv"), std::string::npos);
  }
  EXPECT_TRUE(folder_is_empty());
}

}  // namespace
}  // namespace fbs
