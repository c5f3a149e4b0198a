// Scenes with a wire-frame of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

#include "bitstream/payload/wire_frame_payload.h"
#include "decoder/stream/scene_index.h"
#include "decoder/stream/stream_decoder.h"
#include "tests/unit/decoder/stream/stream_writer.h"
#include "tests/unit/split_head.h"
#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

Writer& add_frame(Writer& w, const WireFrame& frame = *split_head()) {
  return w.packet(PacketType::kWireFrame, encode_wire_frame(frame));
}

Writer& add_split_geometry(Writer& w) {
  return w.packet(PacketType::kGeometry, encode_geometry(split(toy_geometry()))->payload);
}

/// A scene of ten pictures on the split head.
Writer& add_split_scene(Writer& w, const StreamPosition& before = {}) {
  w.setup(setup_at(before));
  add_split_geometry(add_frame(w));
  return w.surround().pattern().motion(0, 10, true);
}

std::size_t vertices_of(const StreamDecoder& decoder) {
  return decoder.scene().geometry->geometry().positions.size();
}

double mean_difference(const Plane& a, const Plane& b) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < a.samples.size(); ++k) sum += std::abs(a.samples[k] - b.samples[k]);
  return static_cast<double>(sum) / static_cast<double>(a.samples.size());
}

TEST(StreamDecoderWireFrame, DrawsASplitHeadAsTheHead) {
  Writer own, generic;
  add_split_scene(own);
  generic.scene({}, 10);
  const Played on_own = played(own.bytes), on_generic = played(generic.bytes);
  EXPECT_TRUE(on_own.errors.empty());
  ASSERT_EQ(on_own.pictures.size(), 10U);
  for (std::size_t i = 0; i < on_own.pictures.size(); ++i)
    EXPECT_LT(mean_difference(on_own.pictures[i].y, on_generic.pictures[i].y), 0.3) << i;
  const Picture &first = on_generic.pictures.front(), &last = on_generic.pictures.back();
  EXPECT_GT(mean_difference(first.y, last.y), 3) << "the head moves";
}

TEST(StreamDecoderWireFrame, IsForTheGeometryBehindIt) {
  Writer plain, w;
  add_split_scene(plain);
  w.setup();
  add_split_geometry(add_frame(add_frame(w, generic_head())));
  add_frame(w, generic_head()).surround().pattern();
  add_frame(w, generic_head()).motion(0, 10, true);
  const Played result = played(w.bytes);
  EXPECT_TRUE(result.errors.empty());
  EXPECT_EQ(result.pictures, played(plain.bytes).pictures);
}

TEST(StreamDecoderWireFrame, AloneMakesNoFace) {
  Writer own, none;
  add_frame(own.setup()).pattern().motion(0, 5, true);
  none.setup().pattern().motion(0, 5, true);
  EXPECT_EQ(played(own.bytes).pictures, played(none.bytes).pictures);
  EXPECT_FALSE(index_scenes(own.bytes).front().face);
}

TEST(StreamDecoderWireFrame, EndsWithItsScene) {
  Writer w;
  add_split_scene(w).scene({10, 30000}, 5);
  add_split_scene(w, {15, 45000}).end(25);
  StreamDecoder decoder;
  decoder.feed(w.bytes);
  decoder.close();
  std::vector<std::size_t> vertices;
  while (*decoder.next() == DecodeStatus::kPicture) vertices.push_back(vertices_of(decoder));
  const std::size_t many = split_head()->vertices.size();
  ASSERT_EQ(vertices.size(), 25U);
  EXPECT_GT(many, std::size_t{kVertexCount});
  EXPECT_EQ(vertices[9], many);
  EXPECT_EQ(vertices[10], std::size_t{kVertexCount});
  EXPECT_EQ(vertices[15], many);
  const auto scenes = index_scenes(w.bytes);
  EXPECT_TRUE(std::all_of(scenes.begin(), scenes.end(), [](const SceneEntry& s) { return s.face; }));
}

TEST(StreamDecoderWireFrame, EndsWithItsSceneInTheIndexToo) {
  const auto flat = make_wire_frame(smallest_tables()).value();
  const std::vector<glm::ivec3> middle(flat->vertices.size());
  Writer w;
  add_frame(w.setup(), *flat).packet(PacketType::kGeometry, encode_geometry({middle, flat})->payload);
  w.pattern().motion(0, 5, true).scene({5, 15000}, 5);
  const auto scenes = index_scenes(w.bytes);
  ASSERT_EQ(scenes.size(), 2U);
  EXPECT_FALSE(scenes[0].face) << "a plane";
  EXPECT_TRUE(scenes[1].face);
}

TEST(StreamDecoderWireFrame, TakesItsSceneWithItWhenItIsLost) {
  Writer w;
  add_split_scene(w).scene({10, 30000}, 5).end(15);
  const std::size_t begin = w.begins[1], end = w.begins[2];
  Bytes flipped = w.bytes, removed = w.bytes;
  flipped[begin + 100] ^= 6;
  removed.erase(removed.begin() + static_cast<std::ptrdiff_t>(begin),
                removed.begin() + static_cast<std::ptrdiff_t>(end));
  for (const Bytes& bytes : {flipped, removed}) {
    const Played result = played(bytes);
    EXPECT_EQ(result.errors.size(), 1U);
    EXPECT_EQ(result.pictures.size(), 5U) << "of the second scene";
    EXPECT_EQ(result.positions.front(), (StreamPosition{10, 30000}));
  }
}

TEST(StreamDecoderWireFrame, TakesItsSceneWithItWhenItIsWrong) {
  const auto right = split_head();
  const std::vector<std::uint16_t> outline(right->outline.size(), right->outline[0]);
  WireFrame wrong = *right;
  wrong.outline = outline;
  Writer w;
  add_frame(w.setup(), wrong).geometry().pattern().motion(0, 5, true);
  const Played result = played(w.bytes);
  ASSERT_EQ(result.errors.size(), 1U);
  EXPECT_EQ(result.errors[0].code, ErrorCode::kInvalidStream);
  EXPECT_EQ(result.errors[0].byte_offset, w.begins[1]);
  EXPECT_TRUE(result.pictures.empty());
  EXPECT_FALSE(index_scenes(w.bytes).front().face) << "nobody sees it";
}

TEST(StreamDecoderWireFrame, BelongsToAScene) {
  Writer w;
  EXPECT_EQ(first_error(add_frame(w)), ErrorCode::kInvalidStream);
}

TEST(StreamDecoderWireFrame, CountsAsGeometry) {
  Writer w;
  add_split_scene(w);
  const Played result = played(w.bytes);
  EXPECT_EQ(result.bytes.geometry, w.begins[4] - w.begins[1]) << "with the surround";
}

}  // namespace
}  // namespace fbs
