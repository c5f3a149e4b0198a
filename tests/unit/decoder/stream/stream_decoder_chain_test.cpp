// The chain of patterns, what is lost with one of them, and patterns that are alone. SPEC 4.4, 6.2.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "decoder/stream/stream_decoder.h"
#include "tests/unit/decoder/stream/stream_writer.h"

namespace fbs {
namespace {

// A pattern that is invalid costs those behind it in the chain, and no picture.
TEST(StreamDecoderChain, DamagedFrameInAPacketOfSeveralCostsTheRestOfItsChain) {
  Writer w = begun(), good = begun();
  w.motion(0, 10, true).blend(3);
  w.patterns({{1, 7, {}, w.frame(face_picture(1))}, {2, 4, {}, Bytes(40, 0xAB)}});
  w.pattern(face_picture(2), 2, 6).blend(7);
  good.motion(0, 10, true).blend(3).pattern(face_picture(1), 1, 7).blend(7);
  const Played result = played(w.bytes);
  ASSERT_EQ(result.errors.size(), 1U);
  EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream);
  EXPECT_EQ(result.errors[0].byte_offset, w.begins[6]);
  EXPECT_EQ(result.pictures, played(good.bytes).pictures);
}

TEST(StreamDecoderChain, OneThatIsAloneIsDrawnFromWhateverBecameOfTheChain) {
  Writer other = begun();
  const Bytes after_first = other.frame(face_picture(4));
  Writer w = begun(), expected = begun();
  w.motion(0, 10, true);
  const std::size_t lost = w.bytes.size();
  w.pattern(face_picture(1), 1, 5);
  const std::size_t found = w.bytes.size();
  w.patterns({{2, 7, {}, after_first, true}}).pattern(face_picture(2), 1, 6).blend(10);
  expected.motion(0, 10, true).patterns({{2, 7, {}, after_first}}).blend(10);
  w.bytes.erase(w.bytes.begin() + static_cast<std::ptrdiff_t>(lost),
                w.bytes.begin() + static_cast<std::ptrdiff_t>(found));
  const Played result = played(w.bytes);
  EXPECT_EQ(result.errors.size(), 1U);
  EXPECT_EQ(result.pictures, played(expected.bytes).pictures);
  EXPECT_NE(result.pictures[7], played(sample().bytes).pictures[7]) << "it counts";
}

TEST(StreamDecoderChain, OnesThatAreAloneAndTheChainDoNotDisturbEachOther) {
  Writer other = begun(), w = begun(), chain = begun();
  const Bytes after_first = other.frame(face_picture(4));  // later frames could refer to it
  w.motion(0, 10, true).pattern(face_picture(1), 1, 5);
  chain.motion(0, 10, true).pattern(face_picture(1), 1, 5);
  w.patterns({{2, 6, {}, after_first, true}}).patterns({{2, 7, {}, after_first, true}});
  w.pattern(face_picture(2), 1, 8).blend(10);
  chain.pattern(face_picture(2), 1, 8).blend(10);
  other.motion(0, 10, true).patterns({{2, 7, {}, after_first}}).blend(10);
  std::vector<Picture> shown;
  for (const Writer* writer : {&w, &chain, &other}) {
    StreamDecoder decoder;
    Played result;
    play_through(decoder, *writer, result);
    EXPECT_TRUE(result.errors.empty());
    for (const Pattern& pattern : decoder.scene().patterns)
      if (pattern.slot > 0) shown.push_back(pattern.picture);
  }
  ASSERT_EQ(shown.size(), 4U);
  EXPECT_EQ(shown[0], shown[2]) << "the chain's";
  EXPECT_EQ(shown[1], shown[3]) << "the other one";
}

// SPEC 6.2
TEST(StreamDecoderChain, LossCostsWhatNeedsThePacket) {
  const auto write = [](bool with_pattern) {
    Writer w = begun();
    w.motion(0, 10, true).blend(2);
    if (with_pattern) w.pattern(face_picture(1), 1, 7);
    w.blend(3, {}, true).motion(10, 15, true).blend(5);
    fbs::Setup next = setup_of(3);
    next.before = {10, 30000};
    w.setup(next).geometry().surround().pattern().motion(0, 5, true).blend(5);
    return w;
  };
  const Writer w = write(true);
  const Played whole = played(w.bytes), plain = played(write(false).bytes);
  ASSERT_EQ(whole.pictures.size(), 15U);
  const auto expect = [&](std::size_t lost, std::size_t shown, const Played& as) {
    Bytes bytes = w.bytes;
    bytes[w.begins[lost] + 3] ^= 3;
    const Played result = played(bytes);
    EXPECT_EQ(result.errors.size(), 1U) << lost;
    EXPECT_EQ(result.positions, whole.positions) << lost;
    for (std::size_t t = 0; t < 15; ++t) {
      const bool held = t >= shown && t < 10;
      EXPECT_EQ(result.held[t], held) << lost << ' ' << t;
      EXPECT_EQ(result.pictures[t], as.pictures[held ? shown - 1 : t])
          << lost << ": held as it was drawn, whatever patterns have come since";
    }
  };
  // A blend in front of a key group: the pattern has come when its pictures are released.
  Writer late = begun();
  late.motion(0, 10, true).pattern(face_picture(1), 1, 7).blend(5).blend(5);
  Played expected = whole;
  const Played together = played(late.bytes);
  std::copy_n(together.pictures.begin(), 2, expected.pictures.begin());
  expect(5, 10, expected);
  expect(6, 10, plain);  // the pattern
  expect(7, 2, whole);   // a blend, and the next one is not key
  expect(8, 10, whole);  // motion of pictures that are not shown
  expect(9, 5, whole);   // the last blend
}

}  // namespace
}  // namespace fbs
