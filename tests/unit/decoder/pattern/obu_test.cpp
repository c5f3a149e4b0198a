#include "decoder/pattern/obu.h"

#include <gtest/gtest.h>

#include <vector>

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(ObuReader, SplitsUnitsWithAndWithoutASize) {
  const Bytes bytes{0x12, 0, 0x0A, 2, 7, 8, 0x30, 1, 2, 3};
  ObuReader reader(bytes);
  const auto delimiter = reader.next(), sequence = reader.next(), frame = reader.next();
  ASSERT_TRUE(delimiter && sequence && frame);
  EXPECT_TRUE(reader.done());
  EXPECT_EQ(delimiter->type, ObuType::kTemporalDelimiter);
  EXPECT_TRUE(delimiter->payload.empty());
  EXPECT_EQ(sequence->type, ObuType::kSequenceHeader);
  EXPECT_EQ(sequence->payload[1], 8);
  EXPECT_EQ(frame->type, ObuType::kFrame);
  EXPECT_EQ(frame->payload.size(), 3U);
}

TEST(ObuReader, ReadsSizesOfSeveralBytes) {
  Bytes bytes{0x32, 0xC8, 0x81, 0x00};  // 200, with a third byte that is needless but allowed
  bytes.resize(4 + 200);
  ObuReader reader(bytes);
  const auto frame = reader.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->payload.size(), 200U);
  EXPECT_TRUE(reader.done());
}

TEST(ObuReader, SkipsTheExtension) {
  const Bytes bytes{0x36, 0x28, 1, 9};
  const auto frame = ObuReader(bytes).next();
  ASSERT_TRUE(frame);
  EXPECT_TRUE(frame->has_extension);
  ASSERT_EQ(frame->payload.size(), 1U);
  EXPECT_EQ(frame->payload[0], 9);
}

TEST(ObuReader, RefusesWhatIsMalformed) {
  for (const Bytes& bytes :
       {Bytes{0xB0, 1}, Bytes{0x32}, Bytes{0x32, 0x80}, Bytes{0x32, 3, 1, 2}, Bytes{0x34},
        Bytes{0x32, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x01, 0}}) {
    const auto refused = ObuReader(bytes).next();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidStream);
  }
}

}  // namespace
}  // namespace fbs
