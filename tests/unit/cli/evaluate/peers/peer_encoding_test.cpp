#include "cli/evaluate/peers/peer_encoding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "cli/evaluate/run/run_folder.h"

namespace fbs::cli {
namespace {

std::string frame(const std::string& bytes) {
  return std::string{static_cast<char>(bytes.size()), 0, 0, 0} + std::string(8, '\0') + bytes;
}

Result<std::uint64_t> bytes_of(const std::string& name, const std::string& content) {
  const auto run = RunFolder::temporary();
  std::ofstream(run->path(name), std::ios::binary) << content;
  return packet_bytes(run->path(name));
}

TEST(PeerEncoding, IvfCountsFramesWithoutTheirTemporalDelimiters) {
  const std::string header(32, 'h'), delimiter{0x12, 0};
  EXPECT_EQ(bytes_of("a.ivf", header + frame(delimiter + "12345") + frame("123")), 8U);
  EXPECT_EQ(bytes_of("a.ivf", header), 0U);
}

TEST(PeerEncoding, RefusesIvfThatIsCutOff) {
  const std::string whole = std::string(32, 'h') + frame("12345");
  EXPECT_FALSE(bytes_of("a.ivf", whole.substr(0, whole.size() - 1)));
  EXPECT_FALSE(bytes_of("a.ivf", whole.substr(0, 36)));
}

TEST(PeerEncoding, OtherStreamsCountAsTheyAre) {
  EXPECT_EQ(bytes_of("a.hevc", "1234567"), 7U);
}

TEST(PeerCodec, HalfSizeNeedsSixtyFourSamples) {
  EXPECT_EQ(peer_variants(176, 144).size(), 6U);
  EXPECT_EQ(peer_variants(176, 120).size(), 3U);
}

int smallest_size(int width, int height) {
  int divisor = 0;
  for (const PeerVariant& variant : peer_variants(width, height))
    divisor = std::max(divisor, variant.divisor);
  return divisor;
}

TEST(PeerCodec, QuarterSizeIsForLargePictures) {
  EXPECT_EQ(smallest_size(400, 400), 2);
  EXPECT_EQ(smallest_size(402, 400), 4);
  EXPECT_EQ(peer_variants(512, 512).size(), 9U);
  EXPECT_EQ(smallest_size(1280, 128), 2) << "a quarter has fewer than 64 samples";
}

TEST(PeerCodec, LabelSaysSizeAndRate) {
  const PeerCodec codec{"x265", "x265", "libx265", "hevc", {}, {}};
  EXPECT_EQ(peer_label(codec, {1, 1}, 51), "x265 crf 51");
  EXPECT_EQ(peer_label(codec, {2, 3}, 45), "x265 1/2 size 1/3 rate crf 45");
}

}  // namespace
}  // namespace fbs::cli
