#include "bitstream/pattern/frame_bits.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A frame with a hidden or shown frame's first bytes.
Bytes frame_of(bool shown, std::size_t size, std::mt19937& random) {
  Bytes frame = {0x30, static_cast<std::uint8_t>(shown ? 0x30 : 0x28)};
  while (frame.size() < size)
    frame.push_back(frame.size() < 12 ? std::uint8_t{0x55} : static_cast<std::uint8_t>(random()));
  return frame;
}

template <class Coder>
void code(Coder& coder, FrameContexts& contexts, Bytes& frame) {
  FramePlace place;
  for (auto& byte : frame) byte = code_frame_byte(coder, contexts, place, byte);
}

double bits_of(FrameContexts& contexts, Bytes frame) {
  BitCounter counter;
  code(counter, contexts, frame);
  return static_cast<double>(counter.bits_x256()) / 256;
}

TEST(FrameBits, RoundTripsFramesOfAnyLength) {
  std::mt19937 random(1);
  FrameContexts writing = initial_frame_contexts(), reading = writing;
  for (std::size_t size = 1; size < 40; ++size) {
    Bytes frame(size), read(size);
    for (auto& byte : frame) byte = static_cast<std::uint8_t>(random());
    RangeEncoder encoder;
    code(encoder, writing, frame);
    const Bytes bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    code(decoder, reading, read);
    EXPECT_TRUE(decoder.ok() && decoder.at_end());
    EXPECT_EQ(read, frame);
  }
}

TEST(FrameBits, HeadersOfEachKindAreLearnedApart) {
  std::mt19937 random(2);
  FrameContexts contexts = initial_frame_contexts();
  for (int i = 0; i < 30; ++i) bits_of(contexts, frame_of(i % 2 == 0, 40, random));
  const double data = (40 - 12) * 8;
  for (const bool shown : {true, false}) {
    const double header = bits_of(contexts, frame_of(shown, 40, random)) - data;
    EXPECT_LT(header, 24) << "of 96 bits";
  }
}

TEST(FrameBits, BytesBehindTheHeaderCostWhatTheyAre) {
  std::mt19937 random(3);
  FrameContexts contexts = initial_frame_contexts();
  const Bytes frame = frame_of(true, kHeaderBytes, random);
  Bytes longer = frame;
  longer.insert(longer.end(), 100, 0);
  FrameContexts same = contexts;
  EXPECT_DOUBLE_EQ(bits_of(contexts, longer), bits_of(same, frame) + 800);
}

// A scene may have no more than one frame of a kind.
TEST(FrameBits, KnowsTheHeadersOfLibaomFromTheStart) {
  for (const Bytes& frame :
       {Bytes{0x30, 0x28, 0x02, 0x40}, Bytes{0x30, 0x30, 0x02, 0x40}, Bytes{0x0A, 0x0B, 0x00, 0x00, 0x00}}) {
    FrameContexts contexts = initial_frame_contexts();
    EXPECT_LT(bits_of(contexts, frame), 7.0 * static_cast<double>(frame.size()));
  }
}

}  // namespace
}  // namespace fbs
