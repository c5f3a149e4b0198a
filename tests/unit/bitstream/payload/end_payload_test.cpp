#include "bitstream/payload/end_payload.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(EndPayload, RoundTrips) {
  for (const std::uint64_t pictures : {std::uint64_t{0}, std::uint64_t{1800}, kMaxStreamPictures}) {
    EXPECT_EQ(decode_end(encode_end(End{pictures}))->pictures, pictures);
  }
  EXPECT_EQ(decode_end(encode_end({kMaxStreamPictures + 1})).error().code, ErrorCode::kTooLarge);
  EXPECT_EQ(decode_end({}).error().code, ErrorCode::kTruncated);
}

}  // namespace
}  // namespace fbs
