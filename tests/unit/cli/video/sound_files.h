// A folder of files with sound for tests, made by ffmpeg.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "cli/evaluate/peers/child_process.h"
#include "cli/video/open/open_video.h"
#include "cli/video/wav_sink.h"
#include "tone_bursts.h"

namespace fbs {

class SoundFiles : public ::testing::Test {
 protected:
  SoundFiles() { std::filesystem::create_directories(folder_); }
  ~SoundFiles() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Runs ffmpeg. Words of `arguments` that end in a suffix are files of the folder.
  void ffmpeg(const std::string& arguments) const {
    std::vector<std::string> command{"ffmpeg", "-v", "error", "-y"};
    std::istringstream words(arguments);
    for (std::string word; words >> word;) command.push_back(is_file(word) ? path(word) : word);
    auto process =
        cli::ChildProcess::start(command, cli::ChildProcess::Pipe::kFromStandardOutput, path("log"));
    ASSERT_TRUE(process) << process.error().text;
    const auto finished = process->finish();
    ASSERT_TRUE(finished) << arguments << ": " << finished.error().text;
  }

  void write_bursts(const std::string& name, int sample_rate, int seconds) const {
    auto sink = WavSink::create(path(name), sample_rate, 1);
    ASSERT_TRUE(sink) << sink.error().text;
    ASSERT_TRUE((*sink)->write(tone_bursts(sample_rate, seconds)));
    ASSERT_TRUE((*sink)->finish());
  }

  [[nodiscard]] std::vector<std::int16_t> read(const std::string& name,
                                               const SoundSourceOptions& options = {}) const {
    std::vector<std::int16_t> samples;
    auto source = open_sound_source(path(name), options);
    EXPECT_TRUE(source) << source.error().text;
    if (!source || *source == nullptr) return samples;
    for (;;) {
      auto more = (*source)->next();
      EXPECT_TRUE(more) << more.error().text;
      if (!more || !*more) return samples;
      EXPECT_FALSE((*more)->empty());
      samples.insert(samples.end(), (*more)->begin(), (*more)->end());
    }
  }

  /// Expects the bursts of numbers first..last, `shift` seconds later than they were made.
  void expect_bursts(const std::string& name, int first, int last, double shift,
                     double tolerance = 0.002) const {
    const std::vector<double> onsets = burst_onsets(read(name), 48000);
    EXPECT_EQ(std::ssize(onsets), last - first + 1) << name;
    for (int i = first; i <= last; ++i)
      EXPECT_NEAR(burst_lag(onsets, burst_time(i) + shift), 0, tolerance) << name << ", burst " << i;
  }

 private:
  static bool is_file(const std::string& word) {
    const std::string suffix = std::filesystem::path(word).extension().string();
    for (const char* known : {".wav", ".mp4", ".mkv", ".mov", ".ts", ".opus", ".bin", ".y4m"})
      if (suffix == known) return true;
    return false;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("fbs_sound_test_" + std::to_string(getpid()));
};

}  // namespace fbs
