// Streams that are cut, damaged or against the rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
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

TEST(StreamDecoderDamage, GoesOnBehindAFlippedBit) {
  const Played whole = played(sample().bytes);
  for (std::size_t bit = 4 * 8; bit < sample().bytes.size() * 8; bit += 53) {
    Bytes bytes = sample().bytes;
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ 1U << bit % 8);
    const Played result = played(bytes);
    ASSERT_FALSE(result.errors.empty()) << bit;
    // Damage in the first motion packet, or before it, leaves nothing; later the last picture is held up to
    // the end.
    const std::size_t packet = std::upper_bound(sample().begins.begin(), sample().begins.end(), bit / 8) -
                               sample().begins.begin() - 1;
    const std::size_t decoded = packet <= 4 ? 0 : 5 * (packet - 4);
    ASSERT_EQ(result.pictures.size(), decoded == 0 ? 0U : 20U) << bit;
    for (std::size_t i = 0; i < result.pictures.size(); ++i)
      EXPECT_EQ(result.pictures[i], whole.pictures[std::min(i, decoded - 1)]) << bit;
  }
}

TEST(StreamDecoderDamage, ErrorsNameTheByteOfTheirPacket) {
  Bytes bytes = sample().bytes;
  bytes[sample().begins[5] + 3] ^= 1;
  const Played result = played(bytes);
  ASSERT_GE(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].byte_offset, sample().begins[5]);
}

// Even a key group is lost: it may belong to a scene whose setup packet is.
TEST(StreamDecoderDamage, LossCostsTheRestOfTheScene) {
  for (const std::size_t lost : {1u, 2u, 3u, 4u, 5u}) {
    Writer w;
    w.scene({}, 5).motion(5, 10).motion(10, 15, true).motion(15, 20);
    w.scene({20, 60000}, 3).end(23);
    Bytes bytes = w.bytes;
    bytes[w.begins[lost] + 3] ^= 1;
    const Played result = played(bytes), whole = played(w.bytes);
    ASSERT_EQ(result.errors.size(), 1u) << "a loss is reported once";
    EXPECT_EQ(result.errors[0].byte_offset, w.begins[lost]);
    if (lost < 5) {
      EXPECT_EQ(result.pictures, std::vector(whole.pictures.end() - 3, whole.pictures.end())) << lost;
      EXPECT_EQ(result.positions.front(), (StreamPosition{20, 60000}));
    } else {
      ASSERT_EQ(result.pictures.size(), 23u);
      EXPECT_EQ(result.positions, whole.positions);
    }
  }
}

/// The stream without bytes `begin`..`end` - 1.
Bytes without(const Bytes& bytes, std::size_t begin, std::size_t end) {
  Bytes out(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(begin));
  out.insert(out.end(), bytes.begin() + static_cast<std::ptrdiff_t>(end), bytes.end());
  return out;
}

// SPEC 3.1, 6.2
TEST(StreamDecoderDamage, PacketThatIsMissingIsReportedAtTheNext) {
  Writer w;
  w.scene({}, 5).motion(5, 10).motion(10, 15).motion(15, 20);  // setup, geometry, surround, pattern, motion
  w.scene({20, 60000}, 3).end(23);
  const Played whole = played(w.bytes);
  for (std::size_t missing = 0; missing < 8; ++missing) {
    const std::size_t begin = w.begins[missing], end = w.begins[missing + 1];
    const Played result = played(without(w.bytes, begin, end));
    ASSERT_EQ(result.errors.size(), 1u) << missing;
    EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream) << missing;
    EXPECT_EQ(result.errors[0].byte_offset, begin) << "where the next packet is now";
    if (missing < 5) {
      EXPECT_EQ(result.pictures, std::vector(whole.pictures.end() - 3, whole.pictures.end())) << missing;
      continue;
    }
    const std::size_t shown = 5 * (missing - 4);
    ASSERT_EQ(result.pictures.size(), 23u);
    EXPECT_EQ(result.positions, whole.positions) << "pictures keep their time";
    for (std::size_t i = 0; i < 23; ++i)
      EXPECT_EQ(result.pictures[i], whole.pictures[i < 20 ? std::min(i, shown - 1) : i]) << missing;
  }
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
    EXPECT_LE(result.pictures.size(), 4u * kMaxGroupPictures);
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
