#include "bitstream/blend/blend_coder.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace fbs {
namespace {

/// @param change  probability of a new mode, 1/256
BlendGroup random_group(std::mt19937& random, bool key, unsigned change) {
  BlendGroup group;
  group.key = key;
  group.modes.resize(1 + random() % (random() % 8 == 0 ? kMaxGroupPictures : 20));
  RegionModes modes{};
  for (RegionModes& picture : group.modes) {
    for (BlendMode& m : modes)
      if (random() % 256 < change) m = static_cast<BlendMode>(random() % kBlendModeCount);
    picture = modes;
  }
  return group;
}

BlendGroup even_group(std::size_t pictures, bool key) {
  return {key, std::vector<RegionModes>(pictures)};
}

TEST(BlendCoder, RoundTripsRandomGroups) {
  std::mt19937 random(1);
  for (const unsigned change : {0u, 3u, 40u, 256u}) {
    BlendEncoder encoder;
    BlendDecoder decoder;
    for (int i = 0; i < 200; ++i) {
      const BlendGroup group = random_group(random, i == 0 || random() % 10 == 0, change);
      const auto payload = encoder.encode(group);
      ASSERT_TRUE(payload);
      const auto read = decoder.decode(*payload);
      ASSERT_TRUE(read) << read.error().text;
      ASSERT_EQ(*read, group) << i;
    }
  }
}

TEST(BlendCoder, UnchangedModesCostNextToNothing) {
  BlendEncoder encoder;
  std::size_t bytes = 0;
  for (int i = 0; i < 20; ++i) bytes = encoder.encode(even_group(30, i == 0))->size();
  EXPECT_LE(bytes, 2U);
}

TEST(BlendCoder, KeyGroupStandsAlone) {
  std::mt19937 random(2);
  BlendEncoder encoder;
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(encoder.encode(random_group(random, i == 0, 50)));
  const BlendGroup key = random_group(random, true, 50), next = random_group(random, false, 50);
  const auto key_payload = encoder.encode(key), next_payload = encoder.encode(next);
  BlendDecoder decoder;
  EXPECT_EQ(*decoder.decode(*key_payload), key);
  EXPECT_EQ(*decoder.decode(*next_payload), next);
}

TEST(BlendCoder, GroupDependsOnTheOneBefore) {
  BlendEncoder encoder;
  ASSERT_TRUE(encoder.encode(even_group(5, true)));
  const auto second = encoder.encode(even_group(5, false));
  BlendDecoder decoder;
  EXPECT_EQ(decoder.decode(*second).error().code, ErrorCode::kInvalidStream);
}

TEST(BlendCoder, AfterAnErrorOnlyAKeyGroupIsRead) {
  BlendEncoder encoder;
  const auto first = encoder.encode(even_group(5, true)), second = encoder.encode(even_group(5, false)),
             third = encoder.encode(even_group(5, true));
  BlendDecoder decoder;
  ASSERT_TRUE(decoder.decode(*first));
  auto longer = *second;
  longer.insert(longer.end(), 40, 0x55);
  EXPECT_EQ(decoder.decode(longer).error().code, ErrorCode::kInvalidStream) << "excess bytes";
  EXPECT_FALSE(decoder.decode(*second));
  EXPECT_TRUE(decoder.decode(*third));
}

TEST(BlendCoder, EncoderRefusesWhatBreaksALimitAndStaysAsItWas) {
  BlendEncoder encoder;
  EXPECT_TRUE(encoder.needs_key());
  const auto refused = [&](const BlendGroup& group) {
    const auto payload = encoder.encode(group);
    return !payload && payload.error().code == ErrorCode::kInvalidArgument;
  };
  EXPECT_TRUE(refused(even_group(5, false))) << "the first is key";
  EXPECT_TRUE(refused(even_group(0, true)));
  EXPECT_TRUE(refused(even_group(kMaxGroupPictures + 1, true)));
  BlendGroup wild = even_group(5, true);
  wild.modes[3][6] = static_cast<BlendMode>(kBlendModeCount);
  EXPECT_TRUE(refused(wild));
  EXPECT_TRUE(encoder.needs_key());
  EXPECT_EQ(*encoder.encode(even_group(7, true)), *BlendEncoder().encode(even_group(7, true)));
  EXPECT_FALSE(encoder.needs_key());
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
    ++read_anyway;
    ASSERT_TRUE(group->key);
    ASSERT_TRUE(BlendEncoder().encode(*group)) << "all in range";
  }
  EXPECT_GT(read_anyway, 100);
}

}  // namespace
}  // namespace fbs
