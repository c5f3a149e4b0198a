#include <fstream>

#include "cli/video/open/open_video.h"
#include "sound_files.h"

namespace fbs {
namespace {

constexpr const char* kPictures = "-f lavfi -i testsrc=s=128x96:r=25:d=6 ";

class SoundSourceFiles : public SoundFiles {
 protected:
  void SetUp() override { ASSERT_NO_FATAL_FAILURE(write_bursts("tone.wav", 44100, 6)); }

  /// @param settings  of the output: codecs and its name
  void make(const std::string& settings) const {
    ASSERT_NO_FATAL_FAILURE(ffmpeg(kPictures + std::string("-i tone.wav ") + settings));
  }

  static void expect_error(const std::string& input, const SoundSourceOptions& options, ErrorCode code,
                           const std::string& text) {
    const auto source = open_sound_source(input, options);
    ASSERT_FALSE(source) << input;
    EXPECT_EQ(source.error().code, code);
    EXPECT_NE(source.error().text.find(text), std::string::npos) << source.error().text;
  }
};

TEST_F(SoundSourceFiles, IsInStepWithPicturesThatBeginTogetherWithIt) {
  make("-c:v libx264 -bf 2 -c:a aac a.mp4");
  expect_bursts("a.mp4", 0, 5, 0);
  make("-c:v libx264 -bf 2 -c:a aac -movflags frag_keyframe+empty_moov b.mp4");
  expect_bursts("b.mp4", 0, 5, 0);
  make("-c:v mpeg4 -c:a flac c.mkv");
  expect_bursts("c.mkv", 0, 5, 0);
}

TEST_F(SoundSourceFiles, WhatComesLaterThanThePicturesBeginsWithSilence) {
  for (const char* settings : {"-c:v libx264 -bf 2 -c:a aac late.mp4", "-c:v mpeg4 -c:a flac late.mkv"}) {
    ASSERT_NO_FATAL_FAILURE(ffmpeg(kPictures + std::string("-itsoffset 0.5 -i tone.wav ") + settings));
    expect_bursts(std::string(settings).substr(std::string(settings).rfind(' ') + 1), 0, 5, 0.5);
  }
}

TEST_F(SoundSourceFiles, SilenceMayLastForSeconds) {
  ffmpeg(kPictures + std::string("-itsoffset 3.25 -i tone.wav -c:v mpeg4 -c:a flac late.mkv"));
  expect_bursts("late.mkv", 0, 5, 3.25);
}

TEST_F(SoundSourceFiles, WhatComesBeforeThePicturesIsLeftOut) {
  // The picture rate is a whole number of 0.5 s, or ffmpeg would put the first picture on the next.
  const std::string pictures = "-itsoffset 0.5 -f lavfi -i testsrc=s=128x96:r=50:d=6 -i tone.wav ";
  ffmpeg(pictures + "-fps_mode passthrough -c:v mpeg4 -c:a flac early.mkv");
  expect_bursts("early.mkv", 1, 5, -0.5);  // burst 0 is at 0.1 s
  ffmpeg("-i early.mkv -c:v copy -c:a aac early.mp4");
  expect_bursts("early.mp4", 1, 5, -0.5);
  ffmpeg("-i early.mkv -c:v libx264 -bf 2 -fps_mode passthrough -c:a mp2 early.ts");
  expect_bursts("early.ts", 1, 5, -0.5);
}

TEST_F(SoundSourceFiles, DelayOfTheOpusEncoderIsLeftOut) {
  // ffmpeg's own Matroska of version 5 is 7 ms wrong, and its MP4 is right.
  make("-c:v mpeg4 -c:a libopus a.mp4");
  expect_bursts("a.mp4", 0, 5, 0);
}

TEST_F(SoundSourceFiles, EverySampleRateAndFormatIsConverted) {
  for (const char* rate : {"8000", "11025", "22050", "96000", "192000"}) {
    make(std::string("-c:v mpeg4 -c:a pcm_s16le -ar ") + rate + " a.mkv");
    expect_bursts("a.mkv", 0, 5, 0);
    EXPECT_NEAR(static_cast<double>(read("a.mkv").size()), 6 * 48000, 48) << rate;
  }
  for (const char* codec : {"pcm_u8", "pcm_s24le", "pcm_f64le"}) {
    make(std::string("-c:v mpeg4 -c:a ") + codec + " a.mkv");
    expect_bursts("a.mkv", 0, 5, 0);
  }
}

TEST_F(SoundSourceFiles, OtherRatesAndStereoAreReturnedAsAsked) {
  make("-c:v mpeg4 -c:a flac a.mkv");
  const auto samples = read("a.mkv", {.sample_rate = 16000, .channels = 2});
  EXPECT_NEAR(static_cast<double>(samples.size()), 6 * 16000 * 2, 32);
  const auto onsets = burst_onsets(samples, 16000, 2);
  ASSERT_EQ(onsets.size(), 6U);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(burst_lag(onsets, burst_time(i)), 0, 0.002);
  for (std::size_t i = 0; i + 1 < samples.size(); i += 2) ASSERT_EQ(samples[i], samples[i + 1]);
}

TEST_F(SoundSourceFiles, FiveChannelsAndBassAreMixedToOne) {
  make(
      "-filter_complex [1:a]pan=5.1|FL=c0|FR=c0|FC=c0|LFE=0*c0|BL=0*c0|BR=0*c0[s] -map 0:v -map [s] "
      "-c:v mpeg4 -c:a pcm_s16le a.mkv");
  expect_bursts("a.mkv", 0, 5, 0);
}

TEST_F(SoundSourceFiles, TracksAreCountedAmongThoseOfSound) {
  ffmpeg(kPictures +
         std::string("-f lavfi -i anullsrc=r=44100:d=6 -i tone.wav -map 1 -map 0 -map 2 -c:v mpeg4 "
                     "-c:a flac a.mkv"));
  EXPECT_TRUE(burst_onsets(read("a.mkv", {.track = 0}), 48000).empty());
  EXPECT_EQ(burst_onsets(read("a.mkv", {.track = 1}), 48000).size(), 6U);
  expect_error(path("a.mkv"), {.track = 2}, ErrorCode::kInvalidArgument, "it has 2");
  expect_error(path("a.mkv"), {.track = -1}, ErrorCode::kInvalidArgument, "it has 2");
}

TEST_F(SoundSourceFiles, SilentSourcesAreNoError) {
  ffmpeg(kPictures + std::string("-c:v mpeg4 a.mp4"));
  ffmpeg(kPictures + std::string("-pix_fmt yuv420p a.y4m"));
  for (const std::string& input :
       {path("a.mp4"), path("a.y4m"), std::string("-"), std::string("camera:0"), path("frame_%05d.png")}) {
    const auto source = open_sound_source(input);
    ASSERT_TRUE(source) << input << ": " << source.error().text;
    EXPECT_EQ(*source, nullptr) << input;
    expect_error(input, {.track = 0}, ErrorCode::kInvalidArgument, "no sound track 0: it has no sound");
  }
}

TEST_F(SoundSourceFiles, MissingFileAndOddOptionsAreErrors) {
  expect_error(path("none.mp4"), {}, ErrorCode::kIo, "none.mp4: No such file");
  expect_error(path("tone.wav"), {.sample_rate = 7999}, ErrorCode::kInvalidArgument, "7999 Hz");
  expect_error(path("tone.wav"), {.channels = 3}, ErrorCode::kInvalidArgument, "3 channels");
}

TEST_F(SoundSourceFiles, EndCutsTheSound) {
  make("-c:v mpeg4 -c:a flac a.mkv");
  EXPECT_EQ(read("a.mkv", {.end = 90000 * 3 / 2}).size(), 72000U);
  EXPECT_TRUE(read("a.mkv", {.end = 0}).empty());
}

TEST_F(SoundSourceFiles, FileOfSoundAloneCountsFromItsStart) {
  expect_bursts("tone.wav", 0, 5, 0);
}

TEST_F(SoundSourceFiles, GapsAreSilenceAndWhatFollowsStaysInPlace) {
  // Packets 20 to 23 of 50 are lost: 93 ms from 0.46 s, 1.63 s, ...
  make("-c:v mpeg4 -c:a aac a.mkv");
  ffmpeg("-i a.mkv -c copy -bsf:a noise=drop=between(mod(n\\,50)\\,20\\,23) lost.mkv");
  const auto onsets = burst_onsets(read("lost.mkv"), 48000);
  for (int i : {0, 2, 4, 5}) EXPECT_NEAR(burst_lag(onsets, burst_time(i)), 0, 0.002) << i;
}

TEST_F(SoundSourceFiles, DamagedPacketsMoveNothing) {
  make("-c:v mpeg4 -c:a ac3 a.mkv");
  ffmpeg("-i a.mkv -c copy -bsf:a noise=amount=if(between(mod(n\\,40)\\,20\\,25)\\,3\\,0) damaged.mkv");
  const auto onsets = burst_onsets(read("damaged.mkv"), 48000);
  EXPECT_NEAR(burst_lag(onsets, burst_time(0)), 0, 0.002);
  EXPECT_NEAR(burst_lag(onsets, burst_time(5)), 0, 0.002);
}

TEST_F(SoundSourceFiles, ShortDamageMovesNothing) {
  make("-c:v mpeg4 -c:a flac -frame_size 441 a.mkv");  // of 10 ms each; one is lost
  ffmpeg("-i a.mkv -c copy -bsf:a noise=amount=if(eq(n\\,60)\\,2\\,0) damaged.mkv");
  auto source = open_sound_source(path("damaged.mkv"));
  ASSERT_TRUE(source && *source);
  while (*(*source)->next()) {
  }
  ASSERT_EQ((*source)->damaged_packets(), 1);
  expect_bursts("damaged.mkv", 0, 5, 0);
}

TEST_F(SoundSourceFiles, OverlapIsLeftOut) {
  make("-t 3 -c:v mpeg2video -c:a mp2 -output_ts_offset 1 a.ts");
  make("-t 3 -c:v mpeg2video -c:a mp2 -output_ts_offset 3.79 b.ts");
  std::ofstream(path("ab.ts"), std::ios::binary) << std::ifstream(path("a.ts"), std::ios::binary).rdbuf()
                                                 << std::ifstream(path("b.ts"), std::ios::binary).rdbuf();
  const auto alone = burst_onsets(read("a.ts"), 48000);
  const auto onsets = burst_onsets(read("ab.ts"), 48000);
  ASSERT_EQ(alone.size(), 3U);
  EXPECT_NEAR(burst_lag(onsets, alone[2]), 0, 0.002);
  EXPECT_NEAR(burst_lag(onsets, alone[1] + 2.79), 0, 0.002);
  EXPECT_NEAR(burst_lag(onsets, alone[2] + 2.79), 0, 0.002);
}

class LongSound : public SoundFiles {
 protected:
  static constexpr int kSeconds = 600;

  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(write_bursts("tone.wav", 44100, kSeconds));
    ASSERT_NO_FATAL_FAILURE(
        ffmpeg("-f lavfi -i testsrc=s=64x64:r=1:d=600 -i tone.wav -c:v mpeg4 "
               "-c:a pcm_s16le straight.mkv"));
  }

  /// @param times  of the packets, in ms, for ffmpeg's setts
  /// @param scale  seconds of these times for a second of the tone
  void expect_in_step(const std::string& times, double scale, double tolerance) const {
    ASSERT_NO_FATAL_FAILURE(ffmpeg("-i straight.mkv -c copy -bsf:a setts=ts=" + times + " a.mkv"));
    const auto onsets = burst_onsets(read("a.mkv"), 48000);
    ASSERT_EQ(std::ssize(onsets), kSeconds);
    for (std::size_t i = 0; i < kSeconds; ++i)
      ASSERT_NEAR(onsets[i], burst_time(static_cast<int>(i)) * scale, tolerance) << i;
  }
};

TEST_F(LongSound, JitterOfTimestampsIsNotHeard) {
  expect_in_step("TS+9*sin(N*1.7)", 1, 0.0005);
}

TEST_F(LongSound, DriftOfTheSoundsClockIsFollowed) {
  expect_in_step("TS*1.0003+8*sin(N*1.7)", 1.0003, 0.004);
}

}  // namespace
}  // namespace fbs
