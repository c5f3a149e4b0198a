#include "bitstream/blend/blend_coder.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <vector>

#include "bitstream/entropy/range_coder.h"

namespace fbs {
namespace {

/// @param change  probability of a new mode, 1/256
BlendGroup random_group(std::mt19937& random, bool key, unsigned change, std::int32_t first = 0) {
  BlendGroup group;
  group.key = key;
  group.first = first;
  group.modes.resize(1 + random() % (random() % 8 == 0 ? kMaxGroupPictures : 20));
  RegionModes modes{};
  for (RegionModes& picture : group.modes) {
    for (BlendMode& m : modes)
      if (random() % 256 < change) m = static_cast<BlendMode>(random() % kBlendModeCount);
    picture = modes;
  }
  return group;
}

BlendGroup even_group(std::size_t pictures, bool key, std::int32_t first = 0) {
  return {key, first, 0, std::vector<RegionModes>(pictures)};
}

TEST(BlendCoder, RoundTripsRandomGroups) {
  std::mt19937 random(1);
  for (const unsigned change : {0u, 3u, 40u, 256u}) {
    BlendEncoder encoder;
    BlendDecoder decoder;
    for (int i = 0; i < 200; ++i) {
      const BlendGroup group = random_group(random, i == 0 || random() % 10 == 0, change, encoder.next());
      const auto payload = encoder.encode(group);
      ASSERT_TRUE(payload);
      const auto read = decoder.decode(*payload);
      ASSERT_TRUE(read) << read.error().text;
      ASSERT_EQ(**read, group) << i;
    }
  }
}

TEST(BlendCoder, UnchangedModesCostNextToNothing) {
  BlendEncoder encoder;
  std::size_t bytes = 0;
  for (int i = 0; i < 20; ++i) bytes = encoder.encode(even_group(30, i == 0, 30 * i))->size();
  EXPECT_LE(bytes, 3U) << "two for the number";
}

/// Groups of one scene, of which every third is key, and their packets.
struct Groups {
  Groups() {
    std::mt19937 random(2);
    BlendEncoder encoder;
    for (int g = 0; g < 7; ++g) {
      groups.push_back(random_group(random, g % 3 == 0, 50, encoder.next()));
      payloads.push_back(*encoder.encode(groups.back()));
    }
  }
  std::vector<BlendGroup> groups;
  std::vector<std::vector<std::uint8_t>> payloads;
};

/// What is read, whatever is missing before it.
BlendGroup read(BlendDecoder& decoder, const std::vector<std::uint8_t>& payload) {
  BlendGroup group = **decoder.decode(payload);
  group.missing = 0;
  return group;
}

TEST(BlendCoder, KeyGroupStandsAlone) {
  const Groups s;
  BlendDecoder decoder;
  for (std::size_t g = 3; g < 7; ++g) EXPECT_EQ(read(decoder, s.payloads[g]), s.groups[g]) << g;
}

TEST(BlendCoder, ALostGroupCostsThoseUpToTheNextKeyGroup) {
  const Groups s;
  for (const std::size_t lost : {0U, 1U, 2U}) {
    BlendDecoder decoder;
    for (std::size_t g = 0; g < lost; ++g) EXPECT_EQ(read(decoder, s.payloads[g]), s.groups[g]);
    for (std::size_t g = lost + 1; g < 3; ++g) EXPECT_EQ(*decoder.decode(s.payloads[g]), std::nullopt);
    for (std::size_t g = 3; g < 7; ++g) EXPECT_EQ(read(decoder, s.payloads[g]), s.groups[g]) << g;
  }
}

TEST(BlendCoder, WhatComesTwiceOrLateIsSkippedAndDoesNoHarm) {
  const Groups s;
  BlendDecoder decoder;
  std::vector<std::size_t> read;
  for (const std::size_t g : {0U, 0U, 1U, 0U, 3U, 2U, 3U, 4U, 1U, 5U}) {
    const auto group = decoder.decode(s.payloads[g]);
    ASSERT_TRUE(group) << group.error().text;
    if (!*group) continue;
    EXPECT_EQ((**group).modes, s.groups[g].modes);
    EXPECT_EQ((**group).missing, g == 3 ? s.groups[3].first - s.groups[2].first : 0);
    read.push_back(g);
  }
  EXPECT_EQ(read, (std::vector<std::size_t>{0, 1, 3, 4, 5}));
}

TEST(BlendCoder, ASceneBeginsWithAKeyGroup) {
  RangeEncoder encoder;
  encoder.raw_bit(kNotKey, false);
  code_first(encoder, 0, 0);
  EXPECT_EQ(BlendDecoder().decode(encoder.finish()).error().code, ErrorCode::kInvalidStream);
}

TEST(BlendCoder, AfterAnErrorOnlyAKeyGroupIsRead) {
  const Groups s;
  BlendDecoder decoder;
  ASSERT_TRUE(decoder.decode(s.payloads[0]));
  auto longer = s.payloads[1];
  longer.insert(longer.end(), 40, 0x55);
  EXPECT_EQ(decoder.decode(longer).error().code, ErrorCode::kInvalidStream) << "excess bytes";
  EXPECT_EQ(*decoder.decode(s.payloads[1]), std::nullopt);
  EXPECT_EQ(read(decoder, s.payloads[3]), s.groups[3]);
}

/// The number that is read where `next` is expected.
std::int32_t first_read(std::int32_t first, std::int32_t next) {
  RangeEncoder encoder;
  code_first(encoder, first, next);
  const auto payload = encoder.finish();
  RangeDecoder decoder(payload);
  return code_first(decoder, 0, next);
}

// SPEC 4.5
TEST(GroupNumber, IsReadWithinItsRange) {
  for (const std::int32_t next : {0, 300, 1000, 1024, 70000}) {
    for (const std::int32_t ahead : {-256, -1, 0, 1, 256, 767})
      EXPECT_EQ(first_read(next + ahead, next), next + ahead) << next;
    EXPECT_EQ(first_read(next + 768, next), next - 256) << "too far ahead: late";
  }
}

TEST(BlendCoder, EncoderRefusesWhatBreaksALimitAndStaysAsItWas) {
  BlendEncoder encoder;
  EXPECT_EQ(encoder.groups(), 0);
  const auto refused = [&](const BlendGroup& group) {
    const auto payload = encoder.encode(group);
    return !payload && payload.error().code == ErrorCode::kInvalidArgument;
  };
  EXPECT_TRUE(refused(even_group(5, false))) << "the first is key";
  EXPECT_TRUE(refused(even_group(5, true, 1))) << "another number";
  EXPECT_TRUE(refused(even_group(0, true)));
  EXPECT_TRUE(refused(even_group(kMaxGroupPictures + 1, true)));
  BlendGroup wild = even_group(5, true);
  wild.modes[3][6] = static_cast<BlendMode>(kBlendModeCount);
  EXPECT_TRUE(refused(wild));
  EXPECT_EQ(encoder.groups(), 0);
  EXPECT_EQ(*encoder.encode(even_group(7, true)), *BlendEncoder().encode(even_group(7, true)));
  EXPECT_EQ(encoder.groups(), 1);
  EXPECT_EQ(encoder.next(), 7);
  EXPECT_TRUE(refused(even_group(5, true))) << "the first number once more";
}

// Whatever arrives: no wild mode, no more pictures than a group may have.
TEST(BlendCoder, SurvivesDamage) {
  std::mt19937 random(3);
  int read_anyway = 0;
  for (int i = 0; i < 20000; ++i) {
    auto payload = *BlendEncoder().encode(random_group(random, true, 60));
    for (unsigned k = 1 + random() % 4; k > 0; --k)
      payload[random() % payload.size()] = static_cast<std::uint8_t>(random());
    if (random() % 4 == 0) payload.resize(random() % (payload.size() + 1));
    BlendDecoder decoder;
    const auto group = decoder.decode(payload);
    if (!group) {
      ASSERT_NE(group.error().code, ErrorCode::kInternal);
      continue;
    }
    if (!*group) continue;
    ++read_anyway;
    ASSERT_TRUE((*group)->key);
    BlendGroup first = **group;
    first.first = 0;
    ASSERT_TRUE(BlendEncoder().encode(first)) << "all in range";
  }
  EXPECT_GT(read_anyway, 100);
}

}  // namespace
}  // namespace fbs
