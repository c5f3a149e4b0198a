// Streams that are cut, damaged or against the rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "decoder/stream_decoder.h"
#include "tests/unit/decoder/stream_writer.h"
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
    ASSERT_LE(result.pictures.size(), 20u);
    // Damage in a motion packet costs its pictures and those up to the next key group, no more.
    if (bit / 8 >= sample().begins[4] && bit / 8 < sample().begins[8]) {
      EXPECT_GE(result.pictures.size(), 10u) << bit;
      for (const Picture& p : result.pictures)
        EXPECT_NE(std::find(whole.pictures.begin(), whole.pictures.end(), p), whole.pictures.end())
            << "a wild picture";
    }
  }
}

TEST(StreamDecoderDamage, ErrorsNameTheByteOfTheirPacket) {
  Bytes bytes = sample().bytes;
  bytes[sample().begins[5] + 3] ^= 1;
  const Played result = played(bytes);
  ASSERT_GE(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].byte_offset, sample().begins[5]);
}

TEST(StreamDecoderDamage, LostGroupCostsThePicturesUpToTheNextKeyGroup) {
  Bytes bytes = sample().bytes;
  const auto at = [&](std::size_t packet) {
    return bytes.begin() + static_cast<std::ptrdiff_t>(sample().begins[packet]);
  };
  bytes.erase(at(4), at(5));  // the first group, key: the second cannot be read
  const Played result = played(bytes), whole = played(sample().bytes);
  ASSERT_EQ(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream);
  ASSERT_EQ(result.pictures.size(), 10u);
  EXPECT_TRUE(std::equal(result.pictures.begin(), result.pictures.end(), whole.pictures.begin() + 10));
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

// The state of the old scene means nothing in the new one.
TEST(StreamDecoderDamage, NothingIsDrawnAfterAnErrorBehindANewSetup) {
  for (const bool with_pattern : {false, true}) {
    Writer w;
    w.setup().geometry().surround().pattern().motion(0, 2, true).setup();
    if (with_pattern) w.geometry().pattern();
    w.packet(PacketType::kMotion, Bytes{});
    StreamDecoder decoder;
    decoder.feed(w.bytes);
    decoder.close();
    Picture out;
    for (int i = 0; i < 2; ++i) {
      ASSERT_EQ(*decoder.next(), DecodeStatus::kPicture);
      ASSERT_TRUE(decoder.render(out));
    }
    ASSERT_FALSE(decoder.next());
    EXPECT_EQ(decoder.render(out).error().code, ErrorCode::kInvalidArgument) << with_pattern;
    EXPECT_EQ(decoder.render(PictureView(out)).error().code, ErrorCode::kInvalidArgument);
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
    for (std::size_t k = 0; k < sample().begins.size(); ++k) {
      const std::size_t begin = sample().begins[k];
      PacketReader reader;
      Bytes one;
      write_signature(one);
      const std::size_t end = k + 1 < sample().begins.size() ? sample().begins[k + 1] : sample().bytes.size();
      one.insert(one.end(), sample().bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                 sample().bytes.begin() + static_cast<std::ptrdiff_t>(end));
      reader.feed(one);
      reader.close();
      const auto packet = reader.next();
      ASSERT_TRUE(packet.has_value());
      Bytes payload(packet->packet.payload.begin(), packet->packet.payload.end());
      if (random() % 4 == 0 && !payload.empty())
        for (unsigned n = random() % 3; n < 3; ++n)
          payload[random() % payload.size()] = static_cast<std::uint8_t>(random());
      write_packet(bytes, packet->packet.type, payload);
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
