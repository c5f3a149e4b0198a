// The head of a scene in parts, and decoders that join with them.
#include "encoder/scene/head_trickle.h"

#include <gtest/gtest.h>

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

TEST(HeadTrickle, WhoeverComesInTheMiddleSeesWhatAllSee) {
  const Trickled t = trickled(2);
  const auto pictures = played(t.w.bytes).pictures;
  ASSERT_EQ(pictures.size(), static_cast<std::size_t>(kGroups * kGroup));
  for (const std::size_t from : {1U, 9U, 25U}) {  // before, around and after the other surround
    const Played joined = played(std::span(t.w.bytes).subspan(t.groups[from]));
    const std::uint64_t first = joined.positions.at(0).pictures;
    EXPECT_LE(first, (from + 12) * kGroup) << "two seconds and a group or two";
    ASSERT_EQ(joined.pictures.size(), pictures.size() - first);
    // At the latest when the surround has been repeated.
    for (std::size_t n = pictures.size() - 30; n < pictures.size(); ++n)
      ASSERT_EQ(joined.pictures[n - first], pictures[n]) << from << ": " << n;
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
  Played joined;
  for (std::size_t k = 5; k + 1 < t.groups.size(); ++k) {
    if (k % 7 == 6) continue;
    joiner.feed_packet(k, std::span(t.w.bytes).subspan(t.groups[k], t.groups[k + 1] - t.groups[k]));
    EXPECT_FALSE(play(joiner, joined));
  }
  while (joiner.skip_missing()) EXPECT_FALSE(play(joiner, joined));
  const std::uint64_t first = joined.positions.at(0).pictures;
  EXPECT_GT(first, 5U * kGroup);
  EXPECT_LE(first, 20U * kGroup);
  EXPECT_EQ(joined.pictures.size(), (kGroups - 1) * kGroup - first);
}

TEST(HeadTrickle, ASceneWhoseHeadIsLostIsJoined) {
  Trickled t = trickled(2);
  t.w.bytes[t.w.begins[1] + 9] ^= 3;  // in the geometry
  const Played joined = played(t.w.bytes);
  const std::uint64_t first = joined.positions.at(0).pictures;
  EXPECT_LE(first, 13U * kGroup);
  EXPECT_EQ(joined.pictures.size(), kGroups * kGroup - first);
}

}  // namespace
}  // namespace fbs
