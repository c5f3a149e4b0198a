#include "tests/figures/wire_frame.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace fbs {
namespace {

constexpr int kPieces = 32;           // of an edge, each hidden or not
constexpr double kDepthSlack = 0.01;  // of the head's height: an edge does not hide behind its own triangles

struct ScreenTriangle {
  std::array<glm::dvec3, 3> corner;

  /// Twice the area; positive when it faces the viewer.
  [[nodiscard]] double area() const {
    const glm::dvec3 b = corner[1] - corner[0], c = corner[2] - corner[0];
    return b.x * c.y - b.y * c.x;
  }

  /// Whether it covers a point that lies deeper than it by more than `slack`.
  [[nodiscard]] bool hides(const glm::dvec3& p, double slack) const {
    double depth = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 a = corner[(i + 1) % 3] - p, b = corner[(i + 2) % 3] - p;
      const double share = (a.x * b.y - a.y * b.x) / area();
      if (share < 0) return false;
      depth += share * corner[i].z;
    }
    return depth + slack < p.z;
  }
};

double height_of(std::span<const glm::dvec3> vertices) {
  const auto [low, high] = std::ranges::minmax(vertices, {}, &glm::dvec3::y);
  return high.y - low.y;
}

}  // namespace

std::vector<LineSegment> visible_edges(const WireFrame& frame, std::span<const glm::dvec3> vertices) {
  std::vector<ScreenTriangle> facing;
  std::map<std::pair<std::uint16_t, std::uint16_t>, bool> edges;  // whether a triangle of it faces the viewer
  for (const HeadTriangle& t : frame.triangles) {
    const ScreenTriangle triangle{{vertices[t[0]], vertices[t[1]], vertices[t[2]]}};
    const bool faces = triangle.area() > 0;
    if (faces) facing.push_back(triangle);
    for (std::size_t i = 0; i < 3; ++i) edges[std::minmax(t[i], t[(i + 1) % 3])] |= faces;
  }
  const double slack = kDepthSlack * height_of(vertices);
  std::vector<LineSegment> out;
  for (const auto& [ends, faces] : edges) {
    if (!faces) continue;
    const glm::dvec3 a = vertices[ends.first], along = vertices[ends.second] - a;
    const auto at = [&](double piece) { return a + along * (piece / kPieces); };
    bool drawing = false;
    for (int i = 0; i < kPieces; ++i) {
      const bool hidden =
          std::ranges::any_of(facing, [&](const ScreenTriangle& t) { return t.hides(at(i + 0.5), slack); });
      if (!hidden && drawing) out.back()[1] = glm::dvec2(at(i + 1));
      if (!hidden && !drawing) out.push_back({glm::dvec2(at(i)), glm::dvec2(at(i + 1))});
      drawing = !hidden;
    }
  }
  return out;
}

std::vector<glm::dvec2> visible_vertices(const WireFrame& frame, std::span<const glm::dvec3> vertices) {
  constexpr double kSame = 1e-9;
  const std::vector<LineSegment> edges = visible_edges(frame, vertices);
  std::vector<glm::dvec2> out;
  for (const glm::dvec3& v : vertices) {
    const auto ends_here = [&](const glm::dvec2& p) { return std::hypot(p.x - v.x, p.y - v.y) < kSame; };
    if (std::ranges::any_of(edges, [&](const LineSegment& e) { return ends_here(e[0]) || ends_here(e[1]); }))
      out.emplace_back(v);
  }
  return out;
}

std::vector<glm::dvec3> screen_vertices(std::span<const glm::ivec3> vertices, const State& state) {
  constexpr double kPixel = 1.0 / 64;  // x and y
  const double pixels_per_unit = std::exp2(state.pose[kLogScale] / 4096.0) / kUnitsPerEyeDistance;
  std::vector<glm::dvec3> out;
  for (const glm::ivec3& v : vertices) out.emplace_back(v.x * kPixel, v.y * kPixel, v.z * pixels_per_unit);
  return out;
}

}  // namespace fbs
