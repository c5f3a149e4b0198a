#include "decoder/draw/silhouette.h"

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace fbs {
namespace {

/// Head units. What is less far behind an edge is not hidden by it but goes on: a lid over its eye, say.
constexpr std::int32_t kFarBehind = 384;

/// Head units. An edge behind what is drawn by more than this is hidden itself.
constexpr std::int32_t kHidden = 768;

/// The softened band is this part of the face's width, as a shift.
constexpr int kBandLog2 = 5;

/// Places along an edge.
constexpr int kAlongLog2 = 12;
constexpr std::int64_t kAlongOne = 1 << kAlongLog2;

/// Edges of which one triangle is drawn and another is not, and which warped sources show.
std::vector<HeadEdge> turning_edges(const ScreenMesh& mesh, const HeadMesh& head,
                                    const HeadWeights& weights) {
  constexpr std::uint8_t kDrawn = 1, kNotDrawn = 2;
  std::vector<std::uint8_t> sides(head.edges.size());
  for (std::size_t t = 0; t < head.triangles.size(); ++t) {
    const auto& [a, b, c] = head.triangles[t];
    const std::uint8_t side =
        faces_viewer({{{mesh.head[a]}, {mesh.head[b]}, {mesh.head[c]}}}) ? kDrawn : kNotDrawn;
    for (const std::uint16_t edge : head.triangle_edges[t]) sides[edge] |= side;
  }
  const auto is_warped = [&](std::uint16_t vertex) { return weights.screen.at(vertex)[0] != 0; };
  std::vector<HeadEdge> out;
  for (std::size_t e = 0; e < sides.size(); ++e) {
    const HeadEdge& edge = head.edges[e];
    if (sides[e] == (kDrawn | kNotDrawn) && (is_warped(edge[0]) || is_warped(edge[1]))) out.push_back(edge);
  }
  return out;
}

/// Marks the samples to be softened in the planes of one scale.
class Marker {
 public:
  Marker(PlaneScale scale, const DepthPlane& depth, std::int64_t radius)
      : depth_(depth), bits_(static_cast<int>(scale)), radius_(radius) {
    const SampleArea& a = depth.area;
    marked_.resize(static_cast<std::size_t>(a.x1 - a.x0) * static_cast<std::size_t>(a.y1 - a.y0));
  }

  void mark_along(const glm::ivec3& from, const glm::ivec3& to) {
    const SampleArea& a = depth_.area;
    const int first = row_of(std::min(from.y, to.y) - radius_, a.y0, a.y1);
    const int last = row_of(std::max(from.y, to.y) + radius_, a.y0 - 1, a.y1 - 1);
    for (int y = first; y <= last; ++y) mark_row(from, to, y);
  }

  [[nodiscard]] const std::vector<glm::ivec2>& samples() const { return samples_; }

 private:
  [[nodiscard]] int row_of(std::int64_t position, int least, int most) const {
    return static_cast<int>(std::clamp<std::int64_t>(position >> bits_, least, most));
  }
  [[nodiscard]] std::int64_t centre(int sample) const {
    return (std::int64_t{sample} << bits_) + (std::int64_t{1} << (bits_ - 1));
  }

  void mark_row(const glm::ivec3& from, const glm::ivec3& to, int y) {
    // Places of the edge no farther away than the radius in y, and a little more.
    std::int64_t begin = 0, end = kAlongOne;
    if (const std::int64_t dy = std::int64_t{to.y} - from.y; dy != 0) {
      // is_near() rounds places of the edge down.
      const std::int64_t above = centre(y) - radius_ - from.y, below = centre(y) + radius_ + 1 - from.y;
      const std::int64_t s = above * kAlongOne / dy, t = below * kAlongOne / dy;
      begin = std::clamp<std::int64_t>(std::min(s, t) - 1, 0, kAlongOne);
      end = std::clamp<std::int64_t>(std::max(s, t) + 1, 0, kAlongOne);
    }
    const std::int64_t dx = std::int64_t{to.x} - from.x;
    const auto [left, right] =
        std::minmax({from.x + (dx * begin >> kAlongLog2), from.x + (dx * end >> kAlongLog2)});
    const SampleArea& a = depth_.area;
    const int first = row_of(left - radius_, a.x0, a.x1);
    const int last = row_of(right + radius_ + 1, a.x0 - 1, a.x1 - 1);
    for (int x = first; x <= last; ++x) {
      std::uint8_t& marked =
          marked_[static_cast<std::size_t>(y - a.y0) * static_cast<std::size_t>(a.x1 - a.x0) +
                  static_cast<std::size_t>(x - a.x0)];
      if (marked != 0 || !is_near(from, to, x, y)) continue;
      marked = 1;
      samples_.emplace_back(x, y);
    }
  }

  /// Whether a sample is near a place of the edge that is seen, with something far behind it.
  [[nodiscard]] bool is_near(const glm::ivec3& from, const glm::ivec3& to, int x, int y) const {
    const std::int64_t dx = std::int64_t{to.x} - from.x, dy = std::int64_t{to.y} - from.y;
    const std::int64_t cx = centre(x) - from.x, cy = centre(y) - from.y, square = dx * dx + dy * dy;
    const std::int64_t along =
        square == 0 ? 0 : std::clamp<std::int64_t>((cx * dx + cy * dy) * kAlongOne / square, 0, kAlongOne);
    const std::int64_t ex = dx * along >> kAlongLog2, ey = dy * along >> kAlongLog2;
    if ((cx - ex) * (cx - ex) + (cy - ey) * (cy - ey) > radius_ * radius_) return false;
    const std::int64_t z = from.z + ((std::int64_t{to.z} - from.z) * along >> kAlongLog2);
    return depth_.row(y)[x] >= z - kHidden && is_far_behind(static_cast<int>((from.x + ex) >> bits_),
                                                            static_cast<int>((from.y + ey) >> bits_), z);
  }

  [[nodiscard]] bool is_far_behind(int x, int y, std::int64_t z) const {
    const SampleArea& a = depth_.area;
    for (int j = std::max(y - 1, a.y0); j <= std::min(y + 1, a.y1 - 1); ++j)
      for (int i = std::max(x - 1, a.x0); i <= std::min(x + 1, a.x1 - 1); ++i)
        if (depth_.row(j)[i] > z + kFarBehind) return true;
    return false;
  }

  const DepthPlane& depth_;
  int bits_;
  std::int64_t radius_;
  std::vector<std::uint8_t> marked_;  ///< of the depth's area
  std::vector<glm::ivec2> samples_;
};

/// The sample and its neighbours, weighted 1, 2, 1 in both directions; beyond the border the last is
/// repeated.
std::uint8_t softened(const PlaneView& plane, glm::ivec2 at) {
  const auto across = [&](int y) {
    const std::uint8_t* const row = plane.row(std::clamp(y, 0, plane.height - 1));
    return row[std::max(at.x - 1, 0)] + 2 * row[at.x] + row[std::min(at.x + 1, plane.width - 1)];
  };
  return static_cast<std::uint8_t>((across(at.y - 1) + 2 * across(at.y) + across(at.y + 1) + 8) >> 4);
}

}  // namespace

void soften_silhouettes(const ScreenMesh& mesh, const HeadMesh& head, const HeadWeights& weights,
                        PlaneScale scale, const DepthPlane& depth, std::span<const PlaneView> planes) {
  const std::vector<HeadEdge> edges = turning_edges(mesh, head, weights);
  if (edges.empty()) return;
  const std::int64_t sample = std::int64_t{1} << static_cast<int>(scale);
  const std::int64_t radius = std::clamp<std::int64_t>(
      face_width(std::span(mesh.head).first(head.head_count)) >> kBandLog2, sample, kMaxSoftened * sample);
  Marker marker(scale, depth, radius);
  for (const HeadEdge& e : edges) marker.mark_along(mesh.head[e[0]], mesh.head[e[1]]);
  const std::int64_t passes = (radius + sample / 2) / sample;
  std::vector<std::uint8_t> soft(marker.samples().size());
  for (const PlaneView& plane : planes)
    for (std::int64_t pass = 0; pass < passes; ++pass) {
      std::transform(marker.samples().begin(), marker.samples().end(), soft.begin(),
                     [&](glm::ivec2 at) { return softened(plane, at); });
      for (std::size_t i = 0; i < soft.size(); ++i) {
        const glm::ivec2 at = marker.samples()[i];
        plane.row(at.y)[at.x] = soft[i];
      }
    }
}

}  // namespace fbs
