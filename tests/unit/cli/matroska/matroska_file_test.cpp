// The writer against the reader, which share no code and no library.
#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>

#include "cli/matroska/matroska_reader.h"
#include "cli/matroska/matroska_writer.h"
#include "cli/matroska/stream_mapping.h"
#include "tests/unit/cli/matroska/voiced_vector.h"

namespace fbs::cli {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes file_of(const MatroskaContent& content) {
  const auto file = write_matroska(content, "test");
  EXPECT_TRUE(file) << file.error().text;
  return file.value_or(Bytes{});
}

void expect_same(const std::vector<MatroskaBlock>& read, const std::vector<MatroskaBlock>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].bytes, written[i].bytes) << i;
    EXPECT_LE(std::abs(read[i].time - written[i].time), kMatroskaTick / 2) << i;
  }
}

TEST(MatroskaFile, HasWhatWasWritten) {
  const auto content = to_matroska(voiced(vector_file("two_heads.fbs")));
  ASSERT_TRUE(content && content->sound);
  const auto read = read_matroska(file_of(*content));
  ASSERT_TRUE(read) << read.error().text;
  EXPECT_TRUE(read->left_out.empty());
  EXPECT_EQ(read->content.video.setup, content->video.setup);
  expect_same(read->content.video.blocks, content->video.blocks);
  ASSERT_TRUE(read->content.sound);
  expect_same(read->content.sound->blocks, content->sound->blocks);
  EXPECT_EQ(read->content.sound->channels, kVoice.channels);
  EXPECT_EQ(read->content.sound->skip, kVoice.skip);
  EXPECT_EQ(read->content.sound->duration, kVoice.duration);
}

TEST(MatroskaFile, BlocksMayBeFarApart) {
  auto content = to_matroska(vector_file("talk.fbs"));
  ASSERT_TRUE(content);
  auto& blocks = content->video.blocks;
  const MatroskaBlock last = blocks.back();
  for (int k = 1; k < 20; ++k) {
    blocks.push_back(last);
    blocks.back().time += std::int64_t{k} * 59'000'000'000;
  }
  const auto read = read_matroska(file_of(*content));
  ASSERT_TRUE(read) << read.error().text;
  expect_same(read->content.video.blocks, blocks);
}

TEST(MatroskaFile, IsTheSameEveryTime) {
  const auto content = to_matroska(voiced(vector_file("talk.fbs")));
  EXPECT_EQ(file_of(*content), file_of(*content));
}

TEST(MatroskaFile, CutAnywhereIsAnError) {
  const Bytes file = file_of(*to_matroska(voiced(vector_file("talk.fbs"))));
  for (std::size_t size = 0; size < file.size(); size += 1 + size / 50)
    EXPECT_FALSE(read_matroska(std::span(file).first(size))) << size;
}

TEST(MatroskaFile, WithoutSuchVideoIsUnsupported) {
  Bytes file = file_of(*to_matroska(vector_file("talk.fbs")));
  constexpr std::string_view kCodec = "V_FBS";
  const auto at = std::search(file.begin(), file.end(), kCodec.begin(), kCodec.end());
  ASSERT_NE(at, file.end());
  *at = 'W';
  const auto read = read_matroska(file);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kUnsupported);
}

TEST(MatroskaFile, ClaimsOfASizeAreCheckedFirst) {
  const Bytes head{0x1A, 0x45, 0xDF, 0xA3, 0x80};                                     // EBML
  const Bytes segment{0x18, 0x53, 0x80, 0x67, 1, 255, 255, 255, 255, 255, 255, 255};  // of unknown size
  const Bytes private_of_track{
      0x16, 0x54, 0xAE, 0x6B, 1, 1,    0,    0,    0,    0,   0, 0,  // Tracks
      0xAE, 1,    0,    255,  0, 0,    0,    0,    0,                // TrackEntry
      0x63, 0xA2, 1,    0,    0, 0x01, 0xFF, 0xFF, 0xFF, 0xFF};      // 8 GiB of CodecPrivate
  Bytes file = head;
  file.insert(file.end(), segment.begin(), segment.end());
  file.insert(file.end(), private_of_track.begin(), private_of_track.end());
  const auto read = read_matroska(file);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kTruncated) << read.error().text;
}

}  // namespace
}  // namespace fbs::cli
