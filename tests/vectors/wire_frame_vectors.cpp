#include "tests/vectors/wire_frame_vectors.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/wire_frame_payload.h"
#include "tests/unit/split_head.h"
#include "tests/vectors/blend_vectors.h"

namespace fbs {
namespace {

Piece packet_of(const WireFrame& frame) {
  return {PacketType::kWireFrame, must(encode_wire_frame(frame))};
}

/// The scene with another head.
std::vector<Piece> on_head(std::vector<Piece> pieces, const Geometry& head) {
  const std::size_t place = place_of(pieces, PacketType::kGeometry);
  pieces[place].payload = must(encode_geometry(head)).payload;
  pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(place), packet_of(*head.own_frame));
  return pieces;
}

std::vector<Piece> on_split_head(const std::vector<Piece>& pieces) {
  const Piece& geometry = pieces[place_of(pieces, PacketType::kGeometry)];
  return on_head(pieces, split(must(decode_geometry(geometry.payload))));
}

/// With wire-frames that have no effect: one before the scene's own, one after the geometry and one after the
/// first pattern.
std::vector<Piece> with_useless_frames(std::vector<Piece> pieces) {
  const Piece other = packet_of(*must(make_wire_frame(smallest_tables())));
  for (const auto& [type, after] :
       {std::pair{PacketType::kPattern, 1}, {PacketType::kGeometry, 1}, {PacketType::kWireFrame, 0}})
    pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(place_of(pieces, type)) + after, other);
  return pieces;
}

/// The scene on the split head and then once more on the generic head.
Bytes two_heads(const Bytes& stream) {
  std::vector<Piece> second = pieces_of(stream);
  const Setup setup = must(decode_setup(second.front().payload));
  const std::uint64_t pictures = must(decode_end(second.back().payload)).pictures;
  second.pop_back();
  std::vector<Piece> pieces = on_split_head(second);
  Setup later = setup;
  later.before = {pictures, pictures * nominal_duration(setup.format.frame_rate)};
  second.front().payload = must(encode_setup(later));
  pieces.insert(pieces.end(), second.begin(), second.end());
  pieces.push_back({PacketType::kEnd, encode_end({2 * pictures})});
  return joined(pieces);
}

std::uint16_t random_below(std::mt19937& random, std::size_t n) {
  return static_cast<std::uint16_t>(random() % n);
}

/// The first `count` of the numbers 0..n - 1 in random order.
std::vector<std::uint16_t> some_of(std::mt19937& random, std::size_t n, std::size_t count) {
  std::vector<std::uint16_t> all(n);
  std::iota(all.begin(), all.end(), std::uint16_t{0});
  for (std::size_t k = n - 1; k > 0; --k) std::swap(all[k], all[random_below(random, k + 1)]);
  all.resize(count);
  return all;
}

std::vector<SkinningWeight> random_skinning(std::mt19937& random) {
  std::vector<SkinningWeight> out;
  for (std::uint16_t c = 0; c < kControlCount; ++c)
    if (const int weight = static_cast<int>(random() % 2048) - 1024;
        random() % 6 == 0 && weight != 0 && out.size() < 8)
      out.push_back({c, static_cast<std::int16_t>(weight)});
  return out;
}

/// Allowed, but not a head: triangles that are turned over, here and in the atlas, and many at a vertex.
WireFrameTables random_tables(std::mt19937& random) {
  constexpr std::size_t kVertices = 120, kTriangles = 150, kOutlineVertices = 17;
  WireFrameTables out;
  const auto coordinate = [&] { return static_cast<std::int32_t>(random() % 8193) - 4096; };
  for (std::size_t v = 0; v < kVertices; ++v) {
    const std::int32_t x = coordinate(), y = coordinate();
    out.positions.emplace_back(x, y, coordinate());
    out.skinning.push_back(random_skinning(random));
  }
  const auto landmarks = some_of(random, kVertices, kLandmarkCount);
  std::copy(landmarks.begin(), landmarks.end(), out.landmark_vertex.begin());
  out.features[static_cast<std::size_t>(FeatureId::kMouthInner)] = {landmarks[60], landmarks[3], landmarks[4],
                                                                    landmarks[64], landmarks[5]};
  std::size_t next = 6;
  for (std::size_t f = 0; f < kFeatureCount; ++f)
    if (out.features[f].empty()) out.features[f] = {landmarks[next++]};
  for (std::size_t k = 0; k < kTriangles; ++k) {
    const auto corners = some_of(random, kVertices, 3);
    out.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  out.triangles.push_back({landmarks[60], landmarks[3], landmarks[5]});  // in the mouth
  out.triangles.push_back({landmarks[4], landmarks[64], landmarks[5]});
  out.outline = some_of(random, kVertices, kOutlineVertices);
  const auto place = [&] { return static_cast<std::int32_t>(random() % 16384); };
  for (std::size_t v = 0; v < kVertices + kOutlineVertices; ++v) {
    const std::int32_t u = place();
    out.atlas.emplace_back(u, place());
  }
  return out;
}

Geometry random_head() {
  std::mt19937 random(3);
  const WireFrameTables tables = random_tables(random);
  return {tables.positions, must(make_wire_frame(tables))};
}

/// A valid code with invalid content.
Bytes with_outline_of_one(std::vector<Piece> pieces) {
  const auto frame = split_head();
  const std::vector<std::uint16_t> outline(frame->outline.size(), frame->outline.front());
  WireFrame wrong = *frame;
  wrong.outline = outline;
  pieces[place_of(pieces, PacketType::kWireFrame)] = packet_of(wrong);
  return joined(pieces);
}

}  // namespace

void add_wire_frames(Folder& folder, const Bytes& talk) {
  folder.add("wire_frame.fbs", joined(on_split_head(pieces_of(talk))), 20);
  const Bytes small = encoded(pictures_of(talker_settings(96, 80, 6)), one_pattern());
  folder.add("useless_wire_frames.fbs", joined(with_useless_frames(on_split_head(pieces_of(small)))), 6);
  folder.add("two_heads.fbs", two_heads(small), 12);
  folder.add("random_wire_frame.fbs", joined(on_head(hand_made_blends(), random_head())), 40);
}

void add_broken_wire_frames(Folder& folder, const Bytes& talk) {
  const auto pieces = on_split_head(pieces_of(talk));
  const std::size_t place = place_of(pieces, PacketType::kWireFrame);
  folder.add("removed_wire_frame.fbs", joined_without(pieces, place), 0, "kInvalidStream");
  Bytes flipped = joined(pieces);
  flipped[offset_of(pieces, place) + 100] ^= 0x30;
  folder.add("flipped_wire_frame.fbs", flipped, 0, "kInvalidStream");
  folder.add("wrong_wire_frame.fbs", with_outline_of_one(pieces), 0, "kInvalidStream");
  auto cut = pieces;
  cut[place].payload.resize(cut[place].payload.size() / 2);
  folder.add("cut_wire_frame.fbs", joined(cut), 0, "kTruncated");
}

}  // namespace fbs
