// Wire-frames other than the generic head. The split head draws the same as the generic head: it is the
// generic head with one more vertex in the middle of most triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "bitstream/syntax.h"
#include "common/generic_head.h"

namespace fbs {

/// Whether a triangle of the generic head is split: not in the mouth, whose triangles have all corners on the
/// inner lips, and not at the outline, so that the border stays the same.
inline bool is_split(const HeadTriangle& corners) {
  const GenericHead& head = generic_head();
  std::size_t on_outline = 0, on_lips = 0;
  for (const std::uint16_t v : corners) {
    on_outline += std::find(head.outline.begin(), head.outline.end(), v) != head.outline.end() ? 1 : 0;
    on_lips += head.vertices[v].feature == static_cast<int>(FeatureId::kMouthInner) ? 1 : 0;
  }
  return on_outline < 2 && on_lips < corners.size();
}

/// Points of the vertices of the generic head, followed by the middles of the split triangles.
template <class Point>
std::vector<Point> with_middles(std::vector<Point> points) {
  for (const HeadTriangle& t : generic_head().triangles)
    if (is_split(t)) points.push_back((points[t[0]] + points[t[1]] + points[t[2]]) / 3);
  return points;
}

/// Weights in the middle of a triangle.
inline std::vector<SkinningWeight> skinning_in_middle(const HeadTriangle& corners) {
  std::map<std::uint16_t, int> sums;
  for (const std::uint16_t v : corners)
    for (const SkinningWeight& s : skinning_of(v)) sums[s.control] += s.weight;
  std::vector<SkinningWeight> out;
  for (const auto& [control, sum] : sums)
    if (sum / 3 != 0) out.push_back({control, static_cast<std::int16_t>(sum / 3)});
  return out;
}

inline WireFrameTables split_head_tables() {
  WireFrameTables out = tables_of(generic_head());
  const auto ring = out.atlas.begin() + kVertexCount;
  const std::vector<glm::ivec2> ring_points(ring, out.atlas.end());
  out.atlas.erase(ring, out.atlas.end());
  out.atlas = with_middles(std::move(out.atlas));
  out.atlas.insert(out.atlas.end(), ring_points.begin(), ring_points.end());
  out.positions = with_middles(std::move(out.positions));
  out.triangles.clear();
  for (const HeadTriangle& t : generic_head().triangles) {
    if (!is_split(t)) {
      out.triangles.push_back(t);
      continue;
    }
    const auto middle = static_cast<std::uint16_t>(out.skinning.size());
    out.skinning.push_back(skinning_in_middle(t));
    for (std::size_t k = 0; k < 3; ++k) out.triangles.push_back({t[k], t[(k + 1) % 3], middle});
  }
  return out;
}

inline std::shared_ptr<const WireFrame> split_head() {
  return make_wire_frame(split_head_tables()).value();
}

/// The same adapted head on the wire-frame split_head().
/// @param generic  on the generic head
inline Geometry split(const Geometry& generic) {
  return {with_middles(generic.positions), split_head()};
}

/// The least of all wire-frames: nothing but landmarks and pupils, all at one place.
inline WireFrameTables smallest_tables(std::size_t vertices = kMinWireFrameVertices) {
  WireFrameTables out;
  out.positions.resize(vertices);
  std::iota(out.landmark_vertex.begin(), out.landmark_vertex.end(), std::uint16_t{0});
  for (std::size_t f = 0; f < kFeatureCount; ++f) out.features[f] = {static_cast<std::uint16_t>(f)};
  out.features[static_cast<std::size_t>(FeatureId::kMouthInner)] = {60, 64};
  out.triangles = {{0, 1, 2}};
  out.outline = {0, 1, 2};
  out.skinning.resize(vertices);
  out.atlas.resize(vertices + out.outline.size());
  return out;
}

}  // namespace fbs
