// The head of a scene in parts, and decoders that join with them.
#include "encoder/scene/head_trickle.h"

#include <gtest/gtest.h>

#include "bitstream/payload/head_part_payload.h"
#include "tests/unit/decoder/stream/stream_writer.h"

namespace fbs {
namespace {

constexpr int kGroup = 6, kGroups = 60;

struct Trickled {
  Writer w;
  std::vector<std::size_t> groups;  ///< offsets
  std::size_t parts = 0;
};

/// Twelve seconds of key groups with parts, and another surround after two.
Trickled trickled(double seconds, const StreamPosition& before = {}) {
  Trickled t;
  HeadTrickle trickle(seconds);
  std::size_t seen = kSignature.size();
  t.w.setup(setup_at(before)).geometry().surround().pattern();
  for (int k = 0; k < kGroups; ++k) {
    t.groups.push_back(t.w.bytes.size());
    t.w.motion(k * kGroup, (k + 1) * kGroup, true);
    if (k == 10) t.w.surround(3);
    trickle.add(std::span(t.w.bytes).subspan(seen));
    seen = t.w.bytes.size();
    for (const auto& [type, payload] : trickle.due()) {
      t.w.packet(type, payload);
      t.parts += type == PacketType::kHeadPart ? 1U : 0U;
    }
    trickle.add(std::span(t.w.bytes).subspan(seen));
    seen = t.w.bytes.size();
  }
  t.w.end(kGroups * kGroup);
  return t;
}

std::vector<Picture> pictures_of(StreamDecoder& decoder, std::uint64_t* first = nullptr) {
  std::vector<Picture> out;
  Picture picture;
  for (;;) {
    const auto status = decoder.next();
    if (!status) continue;
    if (*status != DecodeStatus::kPicture) return out;
    if (out.empty() && first != nullptr) *first = decoder.position().pictures;
    EXPECT_TRUE(decoder.render(picture));
    out.push_back(picture);
  }
}

TEST(HeadTrickle, WhoeverComesInTheMiddleSeesWhatAllSee) {
  const Trickled t = trickled(2);
  StreamDecoder whole;
  whole.feed(t.w.bytes);
  whole.close();
  const auto pictures = pictures_of(whole);
  ASSERT_EQ(pictures.size(), static_cast<std::size_t>(kGroups * kGroup));
  for (const std::size_t from : {1U, 9U, 25U}) {  // before, around and after the other surround
    StreamDecoder joiner;
    joiner.feed(std::span(t.w.bytes).subspan(t.groups[from]));
    joiner.close();
    std::uint64_t first = 0;
    const auto joined = pictures_of(joiner, &first);
    EXPECT_LE(first, (from + 12) * kGroup) << "two seconds and a group or two";
    ASSERT_EQ(joined.size(), pictures.size() - first);
    // At the latest when the surround has been repeated.
    for (std::size_t n = joined.size() - 30; n < joined.size(); ++n)
      ASSERT_EQ(joined[n], pictures[first + n]) << from << " " << n << " " << first;
  }
}

// One in the time that is asked for, and a tenth more; one and a half in the first 1.5 seconds of a later
// scene.
TEST(HeadTrickle, SendsAsManyPartsAsTheTimeAsksFor) {
  const double slow = static_cast<double>(trickled(6.5).parts), fast = static_cast<double>(trickled(2).parts);
  EXPECT_NEAR(slow, 12 * 12 / 6.5 / 0.9, 1);
  EXPECT_EQ(trickled(0).parts, 0U);
  EXPECT_EQ(trickled(0, {100, 300000}).parts, 18U);
  EXPECT_NEAR(fast, 12 * 12 / 2 / 0.9, 1);
}

// Those of a link come with numbers, and the link loses some.
TEST(HeadTrickle, JoinsAlthoughPartsAreLost) {
  const Trickled t = trickled(2);
  StreamDecoder joiner;
  std::vector<Picture> pictures;
  std::uint64_t first = 0;
  for (std::size_t k = 5; k + 1 < t.groups.size(); ++k) {
    if (k % 7 == 6) continue;
    joiner.feed_packet(k, std::span(t.w.bytes).subspan(t.groups[k], t.groups[k + 1] - t.groups[k]));
    std::uint64_t position = 0;
    const auto more = pictures_of(joiner, &position);
    if (pictures.empty() && !more.empty()) first = position;
    pictures.insert(pictures.end(), more.begin(), more.end());
  }
  EXPECT_GT(first, 5U * kGroup);
  EXPECT_LE(first, 20U * kGroup);
  EXPECT_EQ(pictures.size(), (kGroups - 1) * kGroup - first);
}

TEST(HeadTrickle, ASceneWhoseHeadIsLostIsJoined) {
  Trickled t = trickled(2);
  StreamDecoder decoder;
  Bytes bytes(t.w.bytes.begin(), t.w.bytes.begin() + static_cast<std::ptrdiff_t>(t.groups[0]));
  bytes[t.w.begins[1] + 9] ^= 3;  // in the geometry
  bytes.insert(bytes.end(), t.w.bytes.begin() + static_cast<std::ptrdiff_t>(t.groups[0]), t.w.bytes.end());
  decoder.feed(bytes);
  decoder.close();
  std::uint64_t first = 0;
  const auto pictures = pictures_of(decoder, &first);
  EXPECT_LE(first, 13U * kGroup);
  EXPECT_EQ(pictures.size(), kGroups * kGroup - first);
}

}  // namespace
}  // namespace fbs
