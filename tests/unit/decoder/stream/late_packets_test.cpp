// Packets of a link that come late, twice or never. SPEC 6.4.
#include "decoder/stream/late_packets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "decoder/stream/stream_decoder.h"
#include "tests/unit/decoder/stream/stream_writer.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

constexpr int kGroups = 8, kGroup = 5, kPictures = kGroups * kGroup;

/// Key groups of five pictures. Every other one brings a pattern, which needs the pattern before.
const Writer& call() {
  static const Writer w = [] {
    Writer s;
    s.setup(setup_of(3)).geometry().surround().pattern();
    for (int k = 0; k < kGroups; ++k) {
      s.motion(k * kGroup, (k + 1) * kGroup, true);
      if (k % 2 == 1) s.pattern(face_picture(k), k / 2 % 2 + 1, (k + 1) * kGroup - 1);
      s.blend(kGroup, {}, true);
    }
    return s;
  }();
  return w;
}

/// Groups: what a packet of the link brings. The head comes with the first.
std::vector<Bytes> link_packets(const Writer& w = call()) {
  std::vector<std::size_t> cuts = {0};
  for (std::size_t k = 4; k < w.begins.size(); ++k)
    if (k > 4 && static_cast<PacketType>(w.bytes[w.begins[k]]) == PacketType::kMotion)
      cuts.push_back(w.begins[k]);
  cuts.push_back(w.bytes.size());
  std::vector<Bytes> out;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    out.emplace_back(w.bytes.begin() + static_cast<std::ptrdiff_t>(cuts[k]),
                     w.bytes.begin() + static_cast<std::ptrdiff_t>(cuts[k + 1]));
  return out;
}

constexpr std::uint64_t kFirst = 70;  // of the link

/// Plays what has come, and waits for nothing.
void play_at_once(StreamDecoder& decoder, Played& result) {
  do EXPECT_FALSE(play(decoder, result));
  while (decoder.skip_missing());
}

/// Plays packets in this order, each as soon as it comes.
Played played_in(const std::vector<int>& order, StreamDecoder& decoder) {
  const auto packets = link_packets();
  Played result;
  for (const int k : order) {
    decoder.feed_packet(kFirst + static_cast<std::uint64_t>(k), packets[static_cast<std::size_t>(k)]);
    play_at_once(decoder, result);
  }
  EXPECT_TRUE(result.errors.empty());
  return result;
}
Played played_in(const std::vector<int>& order) {
  StreamDecoder decoder;
  return played_in(order, decoder);
}

const std::vector<Picture>& right() {
  static const std::vector<Picture> pictures = played(call().bytes).pictures;
  return pictures;
}

/// Numbers of the pictures that are not as in the whole stream.
std::vector<std::size_t> wrong_in(const Played& result) {
  std::vector<std::size_t> wrong;
  for (std::size_t k = 0; k < result.pictures.size(); ++k)
    if (!(result.pictures[k] == right()[result.positions[k].pictures])) wrong.push_back(k);
  return wrong;
}

TEST(LatePackets, InOrderTheyAreTheStream) {
  ASSERT_EQ(link_packets().size(), static_cast<std::size_t>(kGroups));
  const Played result = played_in({0, 1, 2, 3, 4, 5, 6, 7});
  EXPECT_EQ(result.pictures, right());
}

TEST(LatePackets, AreWaitedForByDistance) {
  const auto packets = link_packets();
  for (const std::size_t late : {0U, 1U, 4U}) {
    StreamDecoder decoder;
    Played result;
    for (std::size_t k = 0; k < packets.size(); ++k) {
      if (k == late) continue;
      decoder.feed_packet(k, packets[k]);
      EXPECT_FALSE(play(decoder, result));
    }
    EXPECT_EQ(result.pictures.size(), late * kGroup);
    EXPECT_EQ(decoder.missing_packets(9), std::vector<std::uint64_t>{late});
    EXPECT_FALSE(decoder.needs_scene());
    decoder.feed_packet(late, packets[late]);
    EXPECT_FALSE(play(decoder, result));
    EXPECT_EQ(result.pictures, right());
    EXPECT_TRUE(result.errors.empty());
    EXPECT_TRUE(decoder.missing_packets(9).empty());
  }
}

TEST(LatePackets, AreGivenUpByDistance) {
  LatePackets late;
  SceneReader reader;
  const Bytes bytes = {1};
  std::uint64_t read = 0;
  for (std::uint64_t k = 0; k < 30; ++k) {
    if (k == 5) continue;
    late.feed(k, bytes);
    while (late.next(reader)) ++read;
    EXPECT_EQ(read, k < 5 ? k + 1 : k > 5 + LatePackets::kReorder ? k : 5U) << k;
    EXPECT_EQ(late.missing(9).size(), k > 5 ? 1U : 0U) << k;
  }
}

TEST(LatePackets, TheFirstMayBeLate) {
  const auto packets = link_packets();
  StreamDecoder decoder;
  Played result;
  for (std::size_t k = 1; k < packets.size(); ++k) {
    decoder.feed_packet(k, packets[k]);
    play_at_once(decoder, result);
  }
  EXPECT_TRUE(result.pictures.empty());
  EXPECT_TRUE(decoder.needs_scene());
  EXPECT_EQ(decoder.missing_packets(9), std::vector<std::uint64_t>{0});
  decoder.feed_packet(0, packets[0]);
  EXPECT_FALSE(play(decoder, result));
  EXPECT_EQ(result.pictures, right());
  EXPECT_TRUE(result.errors.empty());
  EXPECT_FALSE(decoder.needs_scene());
}

// A second scene that overtakes the first does not take its place.
TEST(LatePackets, TheFirstSceneMayBeShort) {
  Writer w;
  w.scene({}, 10).motion(10, 20, true).scene({20, 60000}, 10);
  const auto piece = [&](std::size_t from, std::size_t end) {
    return std::span(w.bytes).subspan(
        w.begins[from], (end < w.begins.size() ? w.begins[end] : w.bytes.size()) - w.begins[from]);
  };
  StreamDecoder decoder;
  Played result;
  decoder.feed_packet(2, piece(6, 11));
  EXPECT_FALSE(play(decoder, result));
  decoder.feed_packet(1, piece(5, 6));
  EXPECT_FALSE(play(decoder, result));
  EXPECT_TRUE(result.pictures.empty());
  decoder.feed_packet(0, piece(0, 5));
  EXPECT_FALSE(play(decoder, result));
  EXPECT_EQ(result.pictures.size(), 30U);
  EXPECT_TRUE(result.errors.empty());
}

// The first number that has come might be any: lower ones are of use until there is a picture.
TEST(LatePackets, JoiningTakesLowerNumbersUntilThereIsAPicture) {
  const Writer& w = call();
  const auto piece = [&](std::size_t from, std::size_t end) {
    return std::span(w.bytes).subspan(w.begins[from], w.begins[end] - w.begins[from]);
  };
  StreamDecoder decoder;
  Played result;
  decoder.feed_packet(kFirst + 2, piece(2, 4));
  play_at_once(decoder, result);
  EXPECT_TRUE(decoder.missing_packets(9).empty());
  decoder.feed_packet(kFirst + 1, piece(1, 2));
  decoder.feed_packet(kFirst, piece(0, 1));
  decoder.feed_packet(kFirst + 3, piece(4, 6));
  EXPECT_FALSE(play(decoder, result));
  EXPECT_EQ(result.pictures.size(), static_cast<std::size_t>(kGroup));
  decoder.feed_packet(kFirst - 1, piece(0, 1));  // a scene before it
  EXPECT_FALSE(play(decoder, result));
  EXPECT_EQ(result.pictures.size(), static_cast<std::size_t>(kGroup));
  EXPECT_TRUE(result.errors.empty());
  EXPECT_TRUE(decoder.missing_packets(9).empty());
}

TEST(LatePackets, DamageIsAnErrorAndLossIsNone) {
  auto packets = link_packets();
  packets[4][packets[4].size() / 2] ^= 0x3C;
  packets[6].pop_back();
  StreamDecoder decoder;
  Played result;
  for (std::size_t k = 0; k < packets.size(); ++k) {
    if (k == 2) continue;
    decoder.feed_packet(k, packets[k]);
    play_at_once(decoder, result);
    EXPECT_FALSE(decoder.needs_scene()) << k;
  }
  EXPECT_EQ(result.errors.size(), 2U);
}

// Groups that are not key need the one before.
TEST(LatePackets, WhatNeedsALostOneNeedsAScene) {
  const Writer& w = sample();
  StreamDecoder decoder;
  Played result;
  for (std::size_t k = 0; k + 1 < w.begins.size(); ++k) {
    if (k == 4) continue;
    decoder.feed_packet(k, std::span(w.bytes).subspan(w.begins[k], w.begins[k + 1] - w.begins[k]));
    play_at_once(decoder, result);
    EXPECT_EQ(decoder.needs_scene(), k == 5) << k;
  }
  EXPECT_TRUE(result.errors.empty());
}

// Here the head of the second scene is lost: its packets have other checks than the first scene's.
TEST(LatePackets, ALostHeadNeedsAScene) {
  Writer w;
  w.scene({}, 10).scene({10, 30000}, 10);
  for (int k = 0; k < 3; ++k) w.motion(10 + 5 * k, 15 + 5 * k, true);
  w.end(35);
  StreamDecoder decoder;
  Played result;
  for (std::size_t k = 0; k + 1 < w.begins.size(); ++k) {
    if (k == 5) continue;
    decoder.feed_packet(k, std::span(w.bytes).subspan(w.begins[k], w.begins[k + 1] - w.begins[k]));
    play_at_once(decoder, result);
    EXPECT_EQ(decoder.needs_scene(), k > 6) << k;
  }
  for (const Error& error : result.errors) ADD_FAILURE() << error.text;
  EXPECT_EQ(result.pictures.size(), 10U);
}

// In the place of the groups that are missing pictures have been held: there are no more.
TEST(LatePackets, AreOfNoUseBehindTheEnd) {
  Writer w;
  w.scene({}, 5).motion(5, 10, true).motion(10, 15, true).end(15);
  const std::vector<std::size_t> cuts = {0, w.begins[5], w.begins[6], w.begins[7], w.bytes.size()};
  StreamDecoder decoder;
  Played result;
  for (const std::size_t k : {0U, 3U, 1U, 2U}) {
    decoder.feed_packet(k, std::span(w.bytes).subspan(cuts[k], cuts[k + 1] - cuts[k]));
    do play(decoder, result);
    while (decoder.skip_missing());
    EXPECT_EQ(result.pictures.size(), k == 0 ? 5U : 15U) << k;
  }
  for (const Error& error : result.errors) ADD_FAILURE() << error.text;
  EXPECT_TRUE(decoder.missing_packets(9).empty());
}

TEST(LatePackets, MayAllBeFedBeforeTheFirstIsRead) {
  const auto packets = link_packets();
  StreamDecoder decoder;
  for (const std::size_t k : {1, 0, 3, 2, 5, 4, 7, 6}) decoder.feed_packet(kFirst + k, packets[k]);
  decoder.close();
  Played result;
  EXPECT_TRUE(play(decoder, result)) << "the end";
  EXPECT_EQ(result.pictures, right());
}

TEST(LatePackets, ThoseBehindALateOneAreRight) {
  // 1 brings a pattern that those of 3 and 5 need.
  const Played result = played_in({0, 2, 3, 1, 4, 5, 6, 7});
  ASSERT_EQ(result.pictures.size(), static_cast<std::size_t>(kPictures));
  const auto wrong = wrong_in(result);
  ASSERT_FALSE(wrong.empty());
  EXPECT_GE(wrong.front(), static_cast<std::size_t>(kGroup));
  EXPECT_LT(wrong.back(), static_cast<std::size_t>(4 * kGroup));
}

TEST(LatePackets, OneThatNeverComesIsFelt) {
  const auto wrong = wrong_in(played_in({0, 2, 3, 4, 5, 6, 7}));
  ASSERT_FALSE(wrong.empty());
  EXPECT_EQ(wrong.back(), static_cast<std::size_t>(kPictures - 1)) << "its pattern is needed to the end";
}

TEST(LatePackets, SeveralMayBeLateInAnyOrder) {
  for (const auto& order : {std::vector<int>{0, 3, 5, 1, 4, 2, 6, 7},
                            {0, 2, 4, 3, 1, 5, 6, 7},
                            {0, 6, 5, 4, 3, 2, 1, 7},
                            {0, 2, 2, 1, 1, 4, 3, 5, 4, 6, 7, 7, 0}}) {
    StreamDecoder decoder;
    const Played result = played_in(order, decoder);
    const auto wrong = wrong_in(result);
    EXPECT_EQ(result.pictures.size(), static_cast<std::size_t>(kPictures));
    EXPECT_TRUE(wrong.empty() || wrong.back() < static_cast<std::size_t>(7 * kGroup));
    EXPECT_TRUE(decoder.missing_packets(9).empty());
  }
}

TEST(LatePackets, TellsWhatIsMissing) {
  StreamDecoder decoder;
  (void)played_in({0, 3, 5}, decoder);
  const std::vector<std::uint64_t> both = {kFirst + 1, kFirst + 2, kFirst + 4};
  EXPECT_EQ(decoder.missing_packets(9), both);
  EXPECT_EQ(decoder.missing_packets(1).size(), 1U);
  decoder.give_up_packets(kFirst + 3);
  EXPECT_EQ(decoder.missing_packets(9), std::vector<std::uint64_t>{kFirst + 4});
  (void)played_in({4}, decoder);
  EXPECT_TRUE(decoder.missing_packets(9).empty());
}

TEST(LatePackets, QualityTellsWhatWasLost) {
  StreamDecoder decoder;
  const auto packets = link_packets();
  std::vector<PictureQuality> qualities;
  const auto feed = [&](std::size_t k) {
    decoder.feed_packet(k, packets[k]);
    do
      while (*decoder.next() == DecodeStatus::kPicture) qualities.push_back(decoder.quality());
    while (decoder.skip_missing());
  };
  for (const std::size_t k : {0, 2, 3, 1, 4}) feed(k);
  ASSERT_EQ(qualities.size(), 5U * kGroup);
  EXPECT_EQ(qualities[kGroup - 1], PictureQuality::kExact);
  EXPECT_EQ(qualities[kGroup], PictureQuality::kInterpolated);
  EXPECT_EQ(qualities[4 * kGroup - 1], PictureQuality::kPatternMissing);
  EXPECT_EQ(qualities[5 * kGroup - 1], PictureQuality::kExact);
}

// A packet is not waited for without end: memory is bounded.
TEST(LatePackets, ThereIsAnEndToWaiting) {
  LatePackets late;
  SceneReader reader;
  const Bytes bytes = {1};
  for (std::uint64_t k = 0; k < 1000; ++k) {
    if (k % 10 == 3) continue;
    late.feed(k, bytes);
    do
      while (late.next(reader)) {
      }
    while (late.skip());
    EXPECT_LT(late.missing(1000).size(), 10U);
  }
}

TEST(LatePackets, ThereIsAnEndToWaitingForTheStart) {
  LatePackets late;
  SceneReader reader;
  for (std::uint64_t k = 20; k < 1000; ++k) {
    if (k % 10 == 3) continue;
    const auto type = k == 25 ? PacketType::kSetup : PacketType::kMotion;
    late.feed(k, Bytes{static_cast<std::uint8_t>(type)});
    while (late.next(reader)) {
    }
    EXPECT_LT(late.missing(1000).size(), 10U);
  }
}

// Pictures of patterns that might come again take memory: there is an end to those, too.
TEST(LatePackets, PatternsAreNotKeptWithoutEnd) {
  Writer w;
  w.setup(setup_of(3)).geometry().surround().pattern();
  constexpr int kMany = 30;
  for (int k = 0; k < kMany; ++k) {
    w.motion(k * kGroup, (k + 1) * kGroup, true);
    if (k != 1) w.pattern(face_picture(k), k % 3, (k + 1) * kGroup - 1);
    w.blend(kGroup, {}, true);
  }
  const auto packets = link_packets(w);
  ASSERT_EQ(packets.size(), static_cast<std::size_t>(kMany));
  StreamDecoder decoder;
  Played result;
  for (std::size_t k = 0; k < packets.size(); ++k) {
    if (k == 1) continue;  // only motion
    decoder.feed_packet(k, packets[k]);
    play_at_once(decoder, result);
    EXPECT_EQ(decoder.missing_packets(9).size(), k > 1 && k < 18 ? 1U : 0U) << k;
  }
  decoder.feed_packet(1, packets[1]);
  EXPECT_FALSE(play(decoder, result));
  EXPECT_EQ(result.pictures.size(), static_cast<std::size_t>(kMany * kGroup));
}

// SPEC 6.6
TEST(LatePackets, ReturnMayComeLate) {
  Writer w;
  std::vector<std::size_t> cuts;
  fbs::Setup other = setup_of(3);
  other.keeps = SceneKeeping::kAndPresent;
  w.setup(setup_of(3)).geometry().surround().pattern().motion(0, 5, true).blend(5);
  other.before = {5, 15000};
  cuts.push_back(w.bytes.size());
  w.setup(other).geometry().surround().pattern(face_picture(1)).motion(0, 5, true).blend(5);
  for (int turn = 2; turn < 6; ++turn) {
    const auto before = static_cast<std::uint64_t>(5 * turn);
    const int from = turn / 2 * 5;
    cuts.push_back(w.bytes.size());
    w.go_back(static_cast<std::size_t>(turn % 2), {before, before * 3000})
        .motion(from, from + 2, true)
        .blend(2);
    cuts.push_back(w.bytes.size());
    w.pattern(face_picture(turn), 1, from + 1).motion(from + 2, from + 5, true).blend(3);
  }
  const Played whole = played(w.bytes);
  ASSERT_TRUE(whole.errors.empty());
  const auto part = [&](std::size_t k) {
    const std::size_t begin = k == 0 ? 0 : cuts[k - 1], end = k == cuts.size() ? w.bytes.size() : cuts[k];
    return std::span(w.bytes).subspan(begin, end - begin);
  };
  for (const std::size_t late : {2U, 4U, 6U}) {
    StreamDecoder decoder;
    Played result;
    for (const std::size_t k : {0U, 1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U, 9U}) {
      if (k != late) decoder.feed_packet(k, part(k));
      EXPECT_FALSE(play(decoder, result));
      if (k != late + 1) continue;
      play_at_once(decoder, result);
      decoder.feed_packet(late, part(late));
      EXPECT_FALSE(play(decoder, result));
    }
    EXPECT_EQ(result.positions, whole.positions) << late;
    EXPECT_EQ(result.pictures, whole.pictures) << late;
    EXPECT_TRUE(result.errors.empty()) << late;
  }
}

// Any order of packets, some lost and some twice: no failure, no picture twice, and right at the end where
// all have come.
TEST(LatePackets, AnyOrderIsSafe) {
  std::mt19937 random(5);
  for (int round = 0; round < 60; ++round) {
    std::vector<int> order(kGroups - 1);
    for (int k = 1; k < kGroups; ++k) order[static_cast<std::size_t>(k - 1)] = k;
    std::shuffle(order.begin(), order.end() - 1, random);
    order.insert(order.begin(), 0);
    StreamDecoder decoder;
    const Played result = played_in(order, decoder);
    ASSERT_EQ(result.pictures.size(), static_cast<std::size_t>(kPictures));
    for (std::size_t k = 0; k < result.positions.size(); ++k) ASSERT_EQ(result.positions[k].pictures, k);
    for (std::size_t k = kPictures - kGroup; k < kPictures; ++k) ASSERT_EQ(result.pictures[k], right()[k]);
  }
}

}  // namespace
}  // namespace fbs
