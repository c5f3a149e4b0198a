#include "decoder/stream/stream_length.h"

#include <gtest/gtest.h>

#include "tests/unit/decoder/stream/stream_writer.h"

namespace fbs::cli {
namespace {

constexpr std::uint64_t kPicture = kTicksPerSecond / 30;

Writer ten_pictures() {
  Writer w;
  w.setup().geometry().surround().pattern().motion(0, 10, true);
  return w;
}

TEST(StreamLength, IsThatOfThePicturesAnnounced) {
  Writer w = ten_pictures();
  w.end(10);
  EXPECT_EQ(stream_length(w.bytes), 10 * kPicture);
}

TEST(StreamLength, CountsFromTheLastScene) {
  Writer w = ten_pictures();
  w.setup(setup_at({10, 123456})).geometry().surround().pattern().motion(0, 5, true).end(15);
  EXPECT_EQ(stream_length(w.bytes), 123456 + 5 * kPicture);
}

TEST(StreamLength, CountsFromTheLastReturn) {
  Writer w = ten_pictures();
  fbs::Setup other = setup_at({10, 123456});
  other.keeps = SceneKeeping::kAndPresent;
  w.setup(other).pattern().motion(0, 5, true).go_back(0, {15, 150000}).motion(10, 12).end(17);
  EXPECT_EQ(stream_length(w.bytes), 150000 + 2 * kPicture);
}

TEST(StreamLength, IsNotKnownWithoutAnEnd) {
  EXPECT_FALSE(stream_length(ten_pictures().bytes));
  EXPECT_FALSE(stream_length({}));
}

TEST(StreamLength, IsKnownOfADamagedStream) {
  Writer w = ten_pictures();
  w.end(10);
  w.bytes[w.begins[3] + 20] ^= 0xFF;
  EXPECT_EQ(stream_length(w.bytes), 10 * kPicture);
}

}  // namespace
}  // namespace fbs::cli
