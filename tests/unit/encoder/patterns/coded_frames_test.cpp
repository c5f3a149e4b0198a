#include "encoder/patterns/coded_frames.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(CodedFrames, KeepsSequenceHeaderAndFramesOnly) {
  const Bytes unit{0x12, 0,                    // temporal delimiter
                   0x0A, 2, 0xA0, 0xA1,        // sequence header
                   0x2A, 1, 0x55,              // metadata
                   0x32, 3, 0x10, 0x11, 0x12,  // frame
                   0x32, 2, 0x20, 0x21,        // frame
                   0x1A, 1, 0x80,              // shows an existing frame
                   0x7A, 1, 0x00};             // padding
  const auto frames = coded_frames(unit);
  ASSERT_TRUE(frames);
  ASSERT_EQ(frames->size(), 2U);
  EXPECT_EQ((*frames)[0], (Bytes{0x0A, 2, 0xA0, 0xA1, 0x30, 0x10, 0x11, 0x12}));
  EXPECT_EQ((*frames)[1], (Bytes{0x30, 0x20, 0x21}));
}

TEST(CodedFrames, AUnitThatShowsAnExistingFrameHasNone) {
  const auto frames = coded_frames(Bytes{0x12, 0, 0x1A, 1, 0x98});
  ASSERT_TRUE(frames);
  EXPECT_TRUE(frames->empty());
}

TEST(CodedFrames, WhatIsNotExpectedIsAnInternalError) {
  for (const Bytes& unit :
       {Bytes{0x1A, 1, 0x10}, Bytes{0x22, 1, 0}, Bytes{0x36, 0, 1, 0}, Bytes{0x32, 9, 0}}) {
    const auto refused = coded_frames(unit);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInternal);
  }
}

}  // namespace
}  // namespace fbs
