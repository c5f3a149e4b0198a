#include "bitstream/scene/head_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "bitstream/payload/head_part_payload.h"

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes noise(std::size_t size) {
  std::mt19937 random(1);
  Bytes out(size);
  std::generate(out.begin(), out.end(), [&] { return static_cast<std::uint8_t>(random()); });
  return out;
}

HeadPart part_of(const Bytes& head, int symbols, int index) {
  return {7, {30, 90000}, head.size(), symbols, index, head_symbol(head, symbols, index)};
}

TEST(HeadParts, AnyPartsThatAreEnoughMakeAHead) {
  for (const auto& [size, symbols] :
       {std::pair<std::size_t, int>{1, 1}, {100, 1}, {99, 4}, {1000, 10}, {3, 8}, {4000, kMaxHeadSymbols}}) {
    const Bytes head = noise(size);
    std::vector<int> indices(kMaxHeadParts);
    std::iota(indices.begin(), indices.end(), 0);
    std::shuffle(indices.begin(), indices.end(), std::mt19937(2));
    HeadParts parts;
    for (int k = 0; k + 1 < symbols; ++k)
      EXPECT_FALSE(parts.add(part_of(head, symbols, indices[static_cast<std::size_t>(k)])));
    EXPECT_EQ(parts.add(part_of(head, symbols, indices.back())), head);
  }
}

// RFC 5510: the generator is x, and so the powers of 2 below 256 are those of x.
TEST(HeadParts, SymbolsAreThoseOfTheFormat) {
  const Bytes head = {1, 2, 3, 0x80};
  EXPECT_EQ(head_symbol(head, 4, 0), Bytes{1 ^ 2 ^ 3 ^ 0x80});
  EXPECT_EQ(head_symbol(head, 2, 1), (Bytes{1 ^ 6, 2 ^ (0x100 ^ 0x11D)}));
}

TEST(HeadParts, OneThatComesTwiceIsLeftOut) {
  const Bytes head = noise(20);
  HeadParts parts;
  EXPECT_FALSE(parts.add(part_of(head, 2, 5)));
  EXPECT_FALSE(parts.add(part_of(head, 2, 5)));
  EXPECT_EQ(parts.add(part_of(head, 2, 6)), head);
}

TEST(HeadParts, AnotherHeadTakesThePlaceOfTheOneBefore) {
  const Bytes head = noise(20);
  HeadParts parts;
  EXPECT_FALSE(parts.add(part_of(head, 2, 5)));
  HeadPart other = part_of(head, 2, 6);
  ++other.scene;
  EXPECT_FALSE(parts.add(other));
  EXPECT_FALSE(parts.add(part_of(head, 2, 7)));
  EXPECT_EQ(parts.add(part_of(head, 2, 5)), head);
}

TEST(HeadPartPayload, IsReadAsItWasWritten) {
  const HeadPart part = part_of(noise(300), 7, kMaxHeadParts - 1);
  const auto read = decode_head_part(encode_head_part(part));
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, part);
}

TEST(HeadPartPayload, EachCutIsNoticed) {
  const Bytes payload = encode_head_part(part_of(noise(30), 3, 0));
  for (std::size_t size = 0; size < payload.size(); ++size) {
    const auto read = decode_head_part(std::span(payload).first(size));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kTruncated);
  }
}

TEST(HeadPartPayload, RefusesWhatIsOutOfRange) {
  const auto code_of = [](std::uint64_t pictures, Bytes behind) -> std::optional<ErrorCode> {
    Bytes payload = {0, 1};
    for (int k = 0; k < 2; ++k) {  // and as many ticks
      std::uint64_t rest = pictures;
      for (; rest >= 0x80; rest >>= 7) payload.push_back(static_cast<std::uint8_t>(rest | 0x80));
      payload.push_back(static_cast<std::uint8_t>(rest));
    }
    payload.insert(payload.end(), behind.begin(), behind.end());
    const auto read = decode_head_part(payload);
    return read ? std::nullopt : std::optional(read.error().code);
  };
  EXPECT_EQ(code_of(5, {4, 2, 0, 1, 2}), std::nullopt);
  EXPECT_EQ(code_of(kMaxPassedPictures + 1, {4, 2, 0, 1, 2}), ErrorCode::kTooLarge);
  EXPECT_EQ(code_of(5, {0, 2, 0}), ErrorCode::kInvalidStream) << "no head";
  EXPECT_EQ(code_of(5, {4, 0, 0, 1, 2}), ErrorCode::kInvalidStream) << "no symbols";
  EXPECT_EQ(code_of(5, {4, 129, 0, 1}), ErrorCode::kTooLarge);
  EXPECT_EQ(code_of(5, {4, 2, 255, 1, 2}), ErrorCode::kInvalidStream) << "no such index";
  EXPECT_EQ(code_of(5, {0x81, 0x80, 4, 128, 0}), ErrorCode::kTooLarge) << "65537 bytes";
  EXPECT_EQ(code_of(5, {4, 2, 0, 1, 2, 3}), ErrorCode::kInvalidStream) << "an excess byte";
}

}  // namespace
}  // namespace fbs
