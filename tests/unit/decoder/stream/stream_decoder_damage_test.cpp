// Streams that are cut, damaged or against the rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "decoder/stream/stream_decoder.h"
#include "tests/unit/decoder/stream/stream_writer.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

TEST(StreamDecoderDamage, StreamMayBeCutAnywhere) {
  const Played whole = played(sample().bytes);
  for (std::size_t size = 0; size < sample().bytes.size(); size += 37) {
    const Played result = played(std::span(sample().bytes).first(size));
    ASSERT_LE(result.errors.size(), 1u) << size;
    const bool at_packet =
        std::find(sample().begins.begin() + 1, sample().begins.end(), size) != sample().begins.end();
    EXPECT_EQ(result.errors.empty(), at_packet) << size;
    if (!result.errors.empty()) {
      EXPECT_EQ(result.errors[0].code, size == 0 ? ErrorCode::kNotFbs : ErrorCode::kTruncated) << size;
    }
    // Every whole motion packet still decodes.
    std::size_t expected = 0;
    for (std::size_t k = 4; k < 8; ++k) expected += sample().begins[k + 1] <= size ? 5 : 0;
    ASSERT_EQ(result.pictures.size(), expected) << size;
    EXPECT_TRUE(std::equal(result.pictures.begin(), result.pictures.end(), whole.pictures.begin())) << size;
  }
}

/// Expects the sample's pictures where packet `lost` of it has not come.
void expect_without(std::size_t lost, const Played& result) {
  const Played whole = played(sample().bytes);
  if (lost < 4) {
    EXPECT_TRUE(result.pictures.empty()) << "the head of the scene";
    return;
  }
  ASSERT_EQ(result.pictures.size(), 20U) << lost;
  EXPECT_EQ(result.positions, whole.positions) << lost;
  for (std::size_t i = 0; i < 20; ++i) {
    if (lost == 4 && i < 10) continue;  // a guess at how the motion begins
    // Motion goes on up to the key group, here as it was; from that group on nothing is known.
    const bool held = (lost == 6 && i >= 10) || (lost == 7 && i >= 15);
    EXPECT_EQ(result.pictures[i], whole.pictures[!held ? i : lost == 6 ? 9 : 14]) << lost << ' ' << i;
    EXPECT_EQ(result.held[i], held) << lost << ' ' << i;
  }
}

TEST(StreamDecoderDamage, GoesOnBehindFlippedBits) {
  for (std::size_t bit = 4 * 8; bit + 1 < sample().bytes.size() * 8; bit += 53) {
    Bytes bytes = sample().bytes;
    for (const std::size_t wrong : {bit, bit + 1})
      bytes[wrong / 8] = static_cast<std::uint8_t>(bytes[wrong / 8] ^ 1U << wrong % 8);
    const Played result = played(bytes);
    ASSERT_EQ(result.errors.size(), 1U) << bit << ": a loss is reported once";
    expect_without(
        static_cast<std::size_t>(std::upper_bound(sample().begins.begin(), sample().begins.end(), bit / 8) -
                                 sample().begins.begin() - 1),
        result);
  }
}

TEST(StreamDecoderDamage, ErrorsNameTheByteOfTheirPacket) {
  Bytes bytes = sample().bytes;
  bytes[sample().begins[5] + 3] ^= 3;
  const Played result = played(bytes);
  ASSERT_GE(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].byte_offset, sample().begins[5]);
}

TEST(StreamDecoderDamage, LossInTheHeadCostsTheScene) {
  for (const std::size_t lost : {1u, 2u, 3u}) {
    Writer w;
    w.scene({}, 5).motion(5, 10).motion(10, 15, true).motion(15, 20);
    w.scene({20, 60000}, 3).end(23);
    Bytes bytes = w.bytes;
    bytes[w.begins[lost] + 3] ^= 3;
    const Played result = played(bytes), whole = played(w.bytes);
    ASSERT_EQ(result.errors.size(), 1u) << "a loss is reported once";
    EXPECT_EQ(result.errors[0].byte_offset, w.begins[lost]);
    EXPECT_EQ(result.pictures, std::vector(whole.pictures.end() - 3, whole.pictures.end())) << lost;
    EXPECT_EQ(result.positions.front(), (StreamPosition{20, 60000}));
  }
}

/// The stream without bytes `begin`..`end` - 1.
Bytes without(const Bytes& bytes, std::size_t begin, std::size_t end) {
  Bytes out(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(begin));
  out.insert(out.end(), bytes.begin() + static_cast<std::ptrdiff_t>(end), bytes.end());
  return out;
}

// SPEC 3.1, 6.2
TEST(StreamDecoderDamage, PacketThatIsMissingIsReportedWhereItIsNoticed) {
  Writer w;
  w.scene({}, 5).motion(5, 10).motion(10, 15).motion(15, 20);  // setup, geometry, surround, pattern, motion
  w.scene({20, 60000}, 3).end(23);
  const Played whole = played(w.bytes);
  for (std::size_t missing = 0; missing < 8; ++missing) {
    const std::size_t begin = w.begins[missing], end = w.begins[missing + 1];
    const Played result = played(without(w.bytes, begin, end));
    ASSERT_EQ(result.errors.size(), 1u) << missing;
    EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream) << missing;
    EXPECT_EQ(result.errors[0].byte_offset, missing < 7 ? begin : w.begins[8] - (end - begin))
        << "at the next packet, or at the next setup packet";
    if (missing < 5) {
      EXPECT_EQ(result.pictures, std::vector(whole.pictures.end() - 3, whole.pictures.end())) << missing;
      continue;
    }
    const std::size_t shown = 5 * (missing - 4);
    EXPECT_EQ(result.errors[0].text, missing < 7 ? "a packet is missing" : "5 pictures are missing");
    ASSERT_EQ(result.pictures.size(), 23u);
    EXPECT_EQ(result.positions, whole.positions) << "pictures keep their time";
    for (std::size_t i = 0; i < 23; ++i)
      EXPECT_EQ(result.pictures[i], whole.pictures[i < 20 ? std::min(i, shown - 1) : i]) << missing;
  }
}

TEST(StreamDecoderDamage, MissingMotionIsReportedAtTheKeyGroupAndGuessed) {
  const auto& b = sample().begins;
  for (const std::size_t missing : {4U, 5U}) {
    const Played result = played(without(sample().bytes, b[missing], b[missing + 1]));
    ASSERT_EQ(result.errors.size(), 1U) << missing;
    EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream);
    EXPECT_EQ(result.errors[0].text, missing == 4 ? "a packet is missing" : "5 pictures are missing");
    EXPECT_EQ(result.errors[0].byte_offset, b[missing]) << "at the next packet";
    expect_without(missing, result);
  }
}

TEST(StreamDecoderDamage, MissingPicturesTakeTheTimeThatTheyHad) {
  Writer w;
  w.scene({}, 2, {3000, 3000}).motion(2, 5, false, {1000, 5000, 1000}).motion(5, 7, true, {4000, 2000});
  const Played result = played(without(w.bytes, w.begins[5], w.begins[6]));
  EXPECT_EQ(result.durations, (std::vector<std::uint32_t>{3000, 3000, 2333, 2333, 2334, 4000, 2000}));
  EXPECT_EQ(result.positions.back(), (StreamPosition{6, 17000}));
}

TEST(StreamDecoderDamage, WhatComesTwiceOrLateChangesNothing) {
  const auto& b = sample().begins;
  Bytes bytes(sample().bytes.begin(), sample().bytes.begin() + static_cast<std::ptrdiff_t>(b[8]));
  for (const std::size_t again : {4U, 7U, 5U})
    bytes.insert(bytes.end(), sample().bytes.begin() + static_cast<std::ptrdiff_t>(b[again]),
                 sample().bytes.begin() + static_cast<std::ptrdiff_t>(b[again + 1]));
  const Played result = played(bytes);
  EXPECT_TRUE(result.errors.empty());
  EXPECT_EQ(result.pictures, played(sample().bytes).pictures);
}

TEST(StreamDecoderDamage, MissingSetupCostsItsScene) {
  Writer w;
  w.scene({}, 5).scene({5, 15000}, 3).scene({8, 24000}, 4).end(12);
  const Played whole = played(w.bytes);
  const Played result = played(without(w.bytes, w.begins[5], w.begins[6]));
  ASSERT_EQ(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].byte_offset, w.begins[5]);
  EXPECT_EQ(result.positions, whole.positions);
  for (std::size_t i = 5; i < 8; ++i) EXPECT_EQ(result.pictures[i], whole.pictures[4]);
}

TEST(StreamDecoderDamage, OrderOfPacketsIsChecked) {
  EXPECT_EQ(first_error(Writer().packet(PacketType::kGeometry, encode_geometry(toy_geometry())->payload)),
            ErrorCode::kInvalidStream)
      << "before the setup";
  EXPECT_EQ(first_error(Writer().packet(PacketType::kMotion, Bytes{1})), ErrorCode::kInvalidStream);
  EXPECT_EQ(first_error(Writer().setup().geometry().motion(0, 3, true)), ErrorCode::kInvalidStream)
      << "no pattern";
  Writer late;
  late.setup();
  late.told_pictures = 10;
  EXPECT_EQ(first_error(late.pattern(face_picture(0), 0, 3)), ErrorCode::kInvalidStream)
      << "a later pattern comes first";
}

TEST(StreamDecoderDamage, EmptyAndUnfinishedStreamsAreErrors) {
  EXPECT_EQ(played({}).errors.at(0).code, ErrorCode::kNotFbs);
  EXPECT_EQ(played(Writer().bytes).errors.at(0).code, ErrorCode::kTruncated) << "a signature alone";
  EXPECT_TRUE(played(Writer().setup().geometry().surround().pattern().bytes).errors.empty())
      << "no picture is no fault";
}

TEST(StreamDecoderDamage, AnotherSizeInsideAStreamIsUnsupported) {
  fbs::Setup other = setup_of();
  other.format.width += 2;
  Writer w;
  w.setup().geometry().surround().pattern().motion(0, 2, true).setup(other);
  const Played result = played(w.bytes);
  ASSERT_EQ(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].code, ErrorCode::kUnsupported);
  EXPECT_EQ(result.pictures.size(), 2u);
}

TEST(StreamDecoderDamage, LastPictureIsStillDrawnAfterAnErrorBehindANewSetup) {
  for (const bool with_pattern : {false, true}) {
    Writer w;
    w.scene({}, 2).setup(setup_at({2, 6000}));
    if (with_pattern) w.geometry().pattern(face_picture(3));
    w.packet(PacketType::kMotion, Bytes{});
    StreamDecoder decoder;
    decoder.feed(w.bytes);
    decoder.close();
    Picture last, out;
    for (int i = 0; i < 2; ++i) {
      ASSERT_EQ(*decoder.next(), DecodeStatus::kPicture);
      ASSERT_TRUE(decoder.render(last));
    }
    ASSERT_FALSE(decoder.next());
    ASSERT_TRUE(decoder.render(out));
    EXPECT_EQ(out, last) << with_pattern;
    EXPECT_TRUE(decoder.scene().geometry) << "the scene of the picture";
  }
}

TEST(StreamDecoderDamage, DamagedAv1IsInvalid) {
  Writer w;
  w.setup().geometry();
  w.patterns({{0, 0, coded_at(0), Bytes(50, 0xAB)}});
  const Played result = played(w.bytes);
  ASSERT_FALSE(result.errors.empty());
  EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream);
  EXPECT_EQ(result.errors[0].byte_offset, w.begins[2]);
}

TEST(StreamDecoderDamage, AFirstPatternThatCannotBeDecodedLosesItsScene) {
  Writer w;
  w.setup().geometry();
  w.patterns({{0, 0, coded_at(0), Bytes(50, 0xAB)}});
  w.motion(0, 5, true);
  const Played result = played(w.bytes);
  EXPECT_EQ(result.errors.size(), 1U);
  EXPECT_TRUE(result.pictures.empty());
}

TEST(StreamDecoderDamage, SurvivesPayloadsThatLieWithRightChecks) {
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    Bytes bytes;
    write_signature(bytes);
    PacketWriter writer;
    PacketReader reader;
    reader.feed(sample().bytes);
    reader.close();
    for (auto read = reader.next(); read->status == ReadStatus::kPacket; read = reader.next()) {
      Bytes payload(read->packet.payload.begin(), read->packet.payload.end());
      if (random() % 4 == 0 && !payload.empty())
        for (unsigned n = random() % 3; n < 3; ++n)
          payload[random() % payload.size()] = static_cast<std::uint8_t>(random());
      writer.write(bytes, read->packet.type, payload);
    }
    const Played result = played(bytes);
    EXPECT_LE(result.pictures.size(), 4u * (1 << kNumberBits) + 128)
        << "four groups, gaps before them, and the end";
  }
}

TEST(StreamDecoderDamage, SurvivesRandomBytesBehindTheSignature) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    Bytes bytes;
    write_signature(bytes);
    for (unsigned n = random() % 600; n > 0; --n)
      bytes.push_back(static_cast<std::uint8_t>(random() % (i % 2 == 0 ? 256 : 8)));
    EXPECT_TRUE(played(bytes).pictures.empty());
  }
}

}  // namespace
}  // namespace fbs
