#include "bitstream/payload/wire_frame_payload.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "common/generic_head.h"
#include "tests/unit/split_head.h"

namespace fbs {
namespace {

using Payload = std::vector<std::uint8_t>;

/// As large as a payload can hold, with a vertex of each limit.
WireFrameTables large_tables() {
  std::mt19937 random(1);
  WireFrameTables t = split_head_tables();
  const auto near = [&](std::int32_t range) { return static_cast<std::int32_t>(random() % 64) * range / 64; };
  t.atlas.resize(t.positions.size());
  while (t.positions.size() < kMaxWireFrameVertices) {
    const std::int32_t x = near(kMaxCoordinate), y = near(kMaxCoordinate);
    t.positions.emplace_back(x, -y, near(kMaxCoordinate));
    t.skinning.push_back({{static_cast<std::uint16_t>(random() % kControlCount), -8}});
    t.atlas.emplace_back(near(kMaxAtlasCoordinate), near(kMaxAtlasCoordinate));
  }
  t.positions.back() = {kMaxCoordinate, -kMaxCoordinate, kMaxCoordinate};
  t.skinning.back() = {{0, -kMaxSkinningSum}};
  t.skinning.front().clear();
  for (std::uint16_t c = 0; c < kControlCount; ++c) t.skinning.front().push_back({c, 1});
  while (t.triangles.size() < kMaxWireFrameTriangles) {
    const auto v = static_cast<std::uint16_t>(random() % (kMaxWireFrameVertices - 2));
    t.triangles.push_back({v, static_cast<std::uint16_t>(v + 2), static_cast<std::uint16_t>(v + 1)});
  }
  t.outline.clear();
  for (std::size_t k = 0; k < kMaxOutline; ++k)
    t.outline.push_back(static_cast<std::uint16_t>(kMaxWireFrameVertices - 1 - k));
  for (std::size_t k = 0; k < kMaxOutline; ++k) t.atlas.emplace_back(kMaxAtlasCoordinate, 0);
  return t;
}

Payload payload_of(const WireFrame& frame) {
  const auto payload = encode_wire_frame(frame);
  EXPECT_TRUE(payload);
  return payload.value_or(Payload{});
}

TEST(WireFramePayload, RoundTrips) {
  for (const WireFrameTables& tables : {tables_of(generic_head()), split_head_tables(), large_tables()}) {
    const auto frame = make_wire_frame(tables);
    ASSERT_TRUE(frame) << frame.error().text;
    const auto decoded = decode_wire_frame(payload_of(**frame));
    ASSERT_TRUE(decoded) << decoded.error().text;
    EXPECT_EQ(tables_of(**decoded), tables);
  }
}

TEST(WireFramePayload, IsSmall) {
  EXPECT_LT(payload_of(generic_head()).size(), 2600U);
  EXPECT_LT(payload_of(*split_head()).size(), 6000U);
}

TEST(WireFramePayload, IsNotTheSameIfCutAnywhere) {
  const auto frame = split_head();
  const Payload payload = payload_of(*frame);
  for (std::size_t size = 0; size < payload.size(); ++size) {
    const auto cut = decode_wire_frame(std::span(payload).first(size));
    if (cut) {  // the zeros past the end are a few bytes, and all places in the atlas that are missing
      EXPECT_NE(tables_of(**cut), tables_of(*frame)) << size;
      continue;
    }
    // Zeros that are read past the end may be numbers out of range.
    const ErrorCode code = cut.error().code;
    EXPECT_TRUE(code == ErrorCode::kTruncated || code == ErrorCode::kInvalidStream) << size;
  }
  EXPECT_EQ(decode_wire_frame(std::span(payload).first(payload.size() / 2)).error().code,
            ErrorCode::kTruncated);
}

TEST(WireFramePayload, RefusesExcessBytes) {
  Payload payload = payload_of(*split_head());
  payload.resize(payload.size() + 20);  // more than a decoder reads past the end
  EXPECT_EQ(decode_wire_frame(payload).error().code, ErrorCode::kInvalidStream);
  payload.assign(kMaxWireFramePayload + 1, 0);
  EXPECT_EQ(decode_wire_frame(payload).error().code, ErrorCode::kTooLarge);
}

/// The payload of tables that no wire-frame can be made from.
/// @param change  of a wire-frame; what it shows must outlive it
template <class Change>
Result<std::shared_ptr<const WireFrame>> decoded_after(Change&& change) {
  const auto frame = split_head();
  WireFrame wrong = *frame;
  change(wrong);
  return decode_wire_frame(payload_of(wrong));
}

TEST(WireFramePayload, RefusesNumbersOutOfRange) {
  const auto right = split_head();
  std::vector<HeadVertex> vertices(right->vertices.begin(), right->vertices.end());
  vertices[9].position.y = kMaxCoordinate + 1;
  std::vector<glm::ivec2> atlas(right->atlas.begin(), right->atlas.end());
  atlas[9].x = -1;
  std::vector<std::uint16_t> outline(right->outline.begin(), right->outline.end());
  outline[9] = static_cast<std::uint16_t>(vertices.size());
  std::vector<HeadTriangle> triangles(right->triangles.begin(), right->triangles.end());
  triangles[9][1] = static_cast<std::uint16_t>(vertices.size());
  std::vector<SkinningWeight> skinning(right->skinning.begin(), right->skinning.end());
  skinning[9].weight = kMaxSkinningSum + 1;
  const std::vector<HeadTriangle> many(kMaxWireFrameTriangles + 1, HeadTriangle{0, 1, 2});
  const auto code = [](const auto& change) { return decoded_after(change).error().code; };
  EXPECT_EQ(code([&](WireFrame& f) { f.vertices = vertices; }), ErrorCode::kInvalidStream);
  EXPECT_EQ(code([&](WireFrame& f) { f.atlas = atlas; }), ErrorCode::kInvalidStream);
  EXPECT_EQ(code([&](WireFrame& f) { f.outline = outline; }), ErrorCode::kInvalidStream);
  EXPECT_EQ(code([&](WireFrame& f) { f.triangles = triangles; }), ErrorCode::kInvalidStream);
  EXPECT_EQ(code([&](WireFrame& f) { f.skinning = skinning; }), ErrorCode::kInvalidStream);
  EXPECT_EQ(code([&](WireFrame& f) { f.triangles = many; }), ErrorCode::kInvalidStream);
}

TEST(WireFramePayload, RefusesWhatIsNoWireFrame) {
  const auto right = split_head();
  const std::vector<std::uint16_t> outline(right->outline.size(), right->outline[0]);
  const auto decoded = decoded_after([&](WireFrame& f) { f.outline = outline; });
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().code, ErrorCode::kInvalidStream);
  EXPECT_NE(decoded.error().text.find("outline"), std::string::npos) << decoded.error().text;
}

// The bytes end after the first number that breaks a rule, which alone matters.
TEST(WireFramePayload, StopsAtTheFirstNumberOutOfRange) {
  const auto right = split_head();
  std::vector<HeadVertex> vertices(right->vertices.begin(), right->vertices.end());
  vertices[0].position.x = kMaxCoordinate + 1;
  WireFrame wrong = *right;
  wrong.vertices = vertices;
  Payload payload = payload_of(wrong);
  payload.resize(40);
  EXPECT_EQ(decode_wire_frame(payload).error().code, ErrorCode::kInvalidStream);
}

TEST(WireFramePayload, TakesAnyBytes) {
  std::mt19937 random(7);
  const Payload payload = payload_of(*split_head());
  for (int i = 0; i < 2000; ++i) {
    Payload changed = payload;
    for (int k = 0; k < 3; ++k)
      changed[random() % changed.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
    const auto frame = decode_wire_frame(changed);
    if (frame) {
      EXPECT_TRUE(make_wire_frame(tables_of(**frame)));
    }
  }
}

}  // namespace
}  // namespace fbs
