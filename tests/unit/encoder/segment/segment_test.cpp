#include "encoder/segment/segment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "bitstream/pattern/pattern_packet.h"

namespace fbs {
namespace {

using Numbers = std::vector<std::size_t>;

/// @param first  number of its first picture in the scene
Segment segment_of(const Numbers& groups, std::int32_t first = 0) {
  Segment s;
  for (const std::size_t pictures : groups) {
    s.groups.push_back({pictures, {static_cast<std::uint8_t>(s.groups.size())}});
    for (std::size_t i = 0; i < pictures; ++i) {
      s.states.emplace_back();
      s.states.back().picture = first + static_cast<std::int32_t>(s.states.size()) - 1;
    }
  }
  return s;
}

/// Pictures of random patterns, coded with look-ahead: the first first, the others in any order.
Numbers random_order(std::mt19937& random, std::size_t pictures) {
  Numbers shown;
  for (std::size_t p = 1; p < pictures; ++p)
    if (random() % 4 == 0) shown.push_back(p);
  std::shuffle(shown.begin(), shown.end(), random);
  shown.insert(shown.begin(), 0);
  return shown;
}

Numbers random_groups(std::mt19937& random) {
  Numbers out(1 + random() % 6);
  for (std::size_t& pictures : out) pictures = 1 + random() % 12;
  return out;
}

TEST(Arrivals, FirstGroupWaitsForTheFirstPatternOnly) {
  const Numbers shown = {0, 5, 10, 15, 19};
  EXPECT_EQ(arrivals(segment_of({5, 5, 5, 5}), shown, true), (Numbers{1, 3, 4, 5}));
  EXPECT_EQ(arrivals(segment_of({5, 5, 5, 5}), shown, false), (Numbers{2, 3, 4, 5}));
}

TEST(Arrivals, LookAheadBringsLaterPatternsEarly) {
  // Pyramid: 0, 16, 8, 4, 12.
  const Numbers shown = {0, 16, 8, 4, 12};
  EXPECT_EQ(arrivals(segment_of({4, 4, 4, 5}), shown, false), (Numbers{4, 4, 5, 5}))
      << "picture 4 is behind the first group, and what is coded before it is there, too";
}

TEST(Arrivals, APatternOfTheLastPictureEndsItsGroup) {
  EXPECT_EQ(arrivals(segment_of({5, 5}), Numbers{0, 4, 9}, false), (Numbers{2, 3}));
}

TEST(Arrivals, AllPatternsArriveEvenForAnOnlyGroup) {
  EXPECT_EQ(arrivals(segment_of({10}), Numbers{0, 9, 5}, false), (Numbers{3}));
  EXPECT_EQ(arrivals(segment_of({10}), Numbers{0, 9, 5}, true), (Numbers{3}))
      << "what does not arrive is coded for nothing, and missing in the next segment";
}

TEST(Arrivals, HasAllUpToTheNextPictureBehindTheGroupAndNoMore) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const Numbers groups = random_groups(random);
    const Segment segment = segment_of(groups);
    const Numbers shown = random_order(random, segment.states.size());
    const Numbers arrived = arrivals(segment, shown, false);
    ASSERT_EQ(arrived.size(), groups.size());
    EXPECT_EQ(arrived.back(), shown.size());
    std::size_t end = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      end += groups[g];
      // The last that is needed: of those not later than the first pattern at or behind the group's end.
      Numbers behind;
      std::copy_if(shown.begin(), shown.end(), std::back_inserter(behind),
                   [&](std::size_t p) { return p + 1 >= end; });
      const std::size_t next = behind.empty() ? end : *std::min_element(behind.begin(), behind.end());
      const auto last = std::find_if(shown.rbegin(), shown.rend(), [&](std::size_t p) { return p <= next; });
      EXPECT_EQ(arrived[g], static_cast<std::size_t>(shown.rend() - last)) << "group " << g;
    }
  }
}

/// Reads packets as the decoder does.
struct Reader {
  const Numbers& groups;
  const Numbers& shown;
  const Numbers& arrived;
  std::int32_t first;
  std::size_t motions = 0, patterns = 0, blends = 0;
  std::size_t moved = 0, drawn = 0;

  void read(const PlannedPacket& packet) {
    if (packet.type == PacketType::kMotion) {
      EXPECT_EQ(packet.first, motions);
      moved += groups[motions++];
    } else if (packet.type == PacketType::kPattern) {
      EXPECT_EQ(packet.first, patterns);
      EXPECT_GE(packet.count, 1U);
      for (std::size_t k = 0; k < packet.count; ++k) {
        const std::size_t picture = shown[patterns++];
        const bool has_own_state = first + picture == 0;
        EXPECT_TRUE(has_own_state || moved > picture) << "its state is known";
        EXPECT_TRUE(!has_own_state || packet.count == 1) << "the first of a scene is alone";
      }
    } else {
      ASSERT_EQ(packet.type, PacketType::kBlend);
      EXPECT_EQ(packet.first, blends);
      EXPECT_EQ(patterns, arrived[blends]) << "drawn from what the encoder has chosen for";
      drawn += groups[blends++];
      EXPECT_GE(moved, drawn);
    }
  }
};

TEST(InStreamOrder, EachPacketComesOnceAndNotBeforeWhatItNeeds) {
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    const Numbers groups = random_groups(random);
    const bool is_first = i % 2 == 0;
    const std::int32_t first = is_first ? 0 : 500;
    const Segment segment = segment_of(groups, first);
    const Numbers shown = random_order(random, segment.states.size());
    const Numbers arrived = arrivals(segment, shown, is_first);
    Reader reader{groups, shown, arrived, first};
    const auto packets = in_stream_order(segment, shown, arrived, Numbers(shown.size(), 100));
    for (const PlannedPacket& packet : packets) reader.read(packet);
    EXPECT_EQ(reader.motions, groups.size());
    EXPECT_EQ(reader.patterns, shown.size());
    EXPECT_EQ(reader.blends, groups.size());
    for (std::size_t k = 1; k + 1 < packets.size(); ++k) {
      const bool later = packets[k].type == PacketType::kPattern && packets[k].first > 0;
      EXPECT_FALSE(later && packets[k + 1].type != PacketType::kBlend &&
                   packets[k + 1].type != PacketType::kMotion)
          << "two could share a packet";
    }
  }
}

TEST(Segment, AMovedPictureKeepsItsNumberAndItsModes) {
  Segment segment = segment_of({3}, 40);
  segment.states[1].blend.fill(BlendMode::kByTime);
  State to;
  to.pose[kShiftX] = 77;
  segment.move(1, to);
  EXPECT_EQ(segment.states[1].pose, to.pose);
  EXPECT_EQ(segment.states[1].picture, 41);
  EXPECT_EQ(segment.states[1].blend[0], BlendMode::kByTime);
}

TEST(InStreamOrder, SceneStartsWithItsFirstPattern) {
  const Numbers shown = {0, 9, 5};
  const Segment segment = segment_of({5, 5});
  const Numbers arrived = arrivals(segment, shown, true);
  const auto packets = in_stream_order(segment, shown, arrived, Numbers(3, 1));
  ASSERT_GE(packets.size(), 3U);
  EXPECT_EQ(packets[0].type, PacketType::kPattern);
  EXPECT_EQ(packets[1].type, PacketType::kMotion);
  EXPECT_EQ(packets[2].type, PacketType::kBlend) << "shown before more patterns arrive";
}

TEST(InStreamOrder, ALaterSegmentStartsWithMotion) {
  const Numbers shown = {0, 9};
  const Segment segment = segment_of({5, 5}, 100);
  const Numbers arrived = arrivals(segment, shown, false);
  const auto packets = in_stream_order(segment, shown, arrived, Numbers(2, 1));
  EXPECT_EQ(packets[0].type, PacketType::kMotion) << "its first pattern has no state of its own";
}

// Readers search behind damage for packets of at most 2^20 bytes.
TEST(InStreamOrder, LargePatternsDoNotShareAPacket) {
  const Numbers shown = {0, 9, 5, 7}, bytes = {20, kMaxPatternsTogether - 10, 10, 1};
  const Segment segment = segment_of({10}, 100);
  const Numbers arrived = arrivals(segment, shown, false);
  const auto packets = in_stream_order(segment, shown, arrived, bytes);
  Numbers together;
  for (const PlannedPacket& p : packets)
    if (p.type == PacketType::kPattern) together.push_back(p.count);
  EXPECT_EQ(together, (Numbers{1, 2, 1})) << "the first and the second are too many bytes";
}

}  // namespace
}  // namespace fbs
