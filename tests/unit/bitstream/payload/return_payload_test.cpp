#include "bitstream/payload/return_payload.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

TEST(ReturnPayload, RoundTrips) {
  for (const Return& to :
       {Return{}, Return{0x1234, {7, 21000}, true, 300}, Return{0xFFFFFF, {1, kMaxDuration}, false},
        Return{9, {kMaxStreamPictures, kMaxStreamTime}, true, kMaxPictureNumber}}) {
    const auto read = decode_return(encode_return(to));
    ASSERT_TRUE(read);
    EXPECT_EQ(*read, to);
  }
}

TEST(ReturnPayload, EachBoundIsChecked) {
  const auto code = [](const Return& to) { return decode_return(encode_return(to)).error().code; };
  EXPECT_EQ(code({1U << 24, {}, false}), ErrorCode::kInvalidStream);
  EXPECT_EQ(code({1, {3, 2}, false}), ErrorCode::kInvalidStream) << "pictures need time";
  EXPECT_EQ(code({1, {kMaxStreamPictures + 1, kMaxStreamTime}, false}), ErrorCode::kTooLarge);
  EXPECT_EQ(code({1, {kMaxStreamPictures, kMaxStreamTime + 1}, false}), ErrorCode::kTooLarge);
  EXPECT_EQ(code({1, {}, false, kMaxPictureNumber + 1}), ErrorCode::kTooLarge);
  auto payload = encode_return({1, {2, 6000}, false});
  payload.back() = 2;
  EXPECT_EQ(decode_return(payload).error().code, ErrorCode::kInvalidStream);
}

TEST(ReturnPayload, IgnoresBytesOfLaterWritersAndReportsMissingOnes) {
  auto payload = encode_return({0x123456, {7, 21000}, true});
  for (std::size_t size = 0; size < payload.size(); ++size)
    EXPECT_EQ(decode_return(std::span(payload).first(size)).error().code, ErrorCode::kTruncated) << size;
  payload.push_back(1);
  EXPECT_TRUE(decode_return(payload));
}

}  // namespace
}  // namespace fbs
