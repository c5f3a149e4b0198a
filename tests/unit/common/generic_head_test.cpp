#include "common/generic_head.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/vec2.hpp>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace fbs {
namespace {

using Edge = std::pair<int, int>;
using Points = std::vector<glm::dvec2>;                 ///< head frame, eye distances, y down
using Offsets = std::array<glm::dvec2, kControlCount>;  ///< eye distances

/// Pairs of control points that are each other's mirror image follow from the features' order (SPEC.md,
/// "State").
int mirror_control(int c) {
  if (c < 10) return (15 - c) % 10;
  if (c < 18) return 10 + (22 - c) % 8;
  if (c < 26) return 43 - c;
  if (c < 30) return 55 - c;
  if (c < 34) return 63 - c;
  return 69 - c;
}

const HeadVertex& vertex(int v) {
  return generic_head().vertices[v];
}

int landmark(int i) {
  return vertex_of_landmark(i);
}

std::map<int, int> weights(int v) {
  const GenericHead& head = generic_head();
  std::map<int, int> row;
  for (auto i = head.skinning_begin[v]; i < head.skinning_begin[static_cast<std::size_t>(v) + 1]; ++i) {
    row[head.skinning[i].control] = head.skinning[i].weight;
  }
  return row;
}

int weight_of(int v, const std::set<int>& controls) {
  int sum = 0;
  for (const auto& [control, weight] : weights(v)) sum += controls.contains(control) ? weight : 0;
  return sum;
}

std::set<int> range(int first, int last) {
  std::set<int> out;
  for (int i = first; i <= last; ++i) out.insert(i);
  return out;
}

std::set<int> controls(FeatureId id) {
  const Feature& f = feature(id);
  return range(f.first_control, f.first_control + f.control_count - 1);
}

Points moved(const Offsets& offsets) {
  Points out;
  for (int v = 0; v < kVertexCount; ++v) {
    glm::dvec2 p(vertex(v).position.x, vertex(v).position.y);
    p /= kUnitsPerEyeDistance;
    for (const auto& [control, weight] : weights(v)) {
      p += offsets[control] * (static_cast<double>(weight) / kSkinningOne);
    }
    out.push_back(p);
  }
  return out;
}

double cross(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// Positive when the triangle is clockwise in the picture, where y points down.
double area(const Points& p, const HeadTriangle& t) {
  const glm::dvec2 a = p[t[0]];
  return cross(p[t[1]] - a, p[t[2]] - a) / 2;
}

double smallest_angle_deg(const Points& p, const HeadTriangle& t) {
  double smallest = 180;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 a = p[t[i]];
    const glm::dvec2 u = p[t[(i + 1) % 3]] - a;
    const glm::dvec2 v = p[t[(i + 2) % 3]] - a;
    const double angle = std::atan2(std::abs(cross(u, v)), u.x * v.x + u.y * v.y);
    smallest = std::min(smallest, angle * 180 / std::numbers::pi);
  }
  return smallest;
}

std::string describe(const HeadTriangle& t) {
  return std::string(vertex(t[0]).name) + ", " + std::string(vertex(t[1]).name) + ", " +
         std::string(vertex(t[2]).name);
}

void expect_nothing_folds(const Offsets& offsets) {
  const Points points = moved(offsets);
  for (const HeadTriangle& t : generic_head().triangles) EXPECT_GT(area(points, t), 0) << describe(t);
}

/// How often each directed edge is used; a manifold without folds uses each once.
std::map<Edge, int> directed_edges() {
  std::map<Edge, int> edges;
  for (const HeadTriangle& t : generic_head().triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  return edges;
}

/// Inner lips and the triangles between them.
bool is_mouth_opening(const HeadTriangle& t) {
  return std::all_of(t.begin(), t.end(), [](int v) { return vertex(v).landmark >= 60; });
}

TEST(GenericHead, HasEachLandmarkOnce) {
  std::vector<int> seen(kLandmarkCount, 0);
  for (int v = 0; v < kVertexCount; ++v) {
    if (vertex(v).landmark < 0) continue;
    ASSERT_LT(vertex(v).landmark, kLandmarkCount);
    ++seen[vertex(v).landmark];
    EXPECT_EQ(landmark(vertex(v).landmark), v);
  }
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), kLandmarkCount);
}

TEST(GenericHead, NamesAreUnique) {
  std::set<std::string_view> names;
  for (const HeadVertex& v : generic_head().vertices) names.insert(v.name);
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kVertexCount));
}

TEST(GenericHead, MirrorsMirrorBack) {
  for (int v = 0; v < kVertexCount; ++v) {
    const HeadVertex& twin = vertex(vertex(v).mirror);
    EXPECT_EQ(twin.mirror, v);
    EXPECT_EQ(twin.position, vertex(v).position * glm::ivec3(-1, 1, 1)) << vertex(v).name;
  }
}

TEST(GenericHead, EyeCentresAreOneUnitApartAtTheOrigin) {
  glm::ivec3 right(0);
  glm::ivec3 left(0);
  for (int i = 36; i < 42; ++i) right += vertex(landmark(i)).position;
  for (int i = 42; i < 48; ++i) left += vertex(landmark(i)).position;
  EXPECT_EQ(left.x, 3 * kUnitsPerEyeDistance);
  EXPECT_EQ(right.x, -left.x);
  EXPECT_EQ(left.y, 0);
  EXPECT_EQ(right.y, 0);
}

TEST(GenericHead, HasHumanProportions) {
  const auto at = [](int i) { return glm::dvec3(vertex(landmark(i)).position) / 4096.0; };
  EXPECT_NEAR(at(16).x - at(0).x, 2.2, 0.1);     // face width
  EXPECT_NEAR(at(54).x - at(48).x, 0.8, 0.05);   // mouth width
  EXPECT_NEAR(at(45).x - at(42).x, 0.45, 0.03);  // eye fissure
  EXPECT_NEAR(at(8).y, 1.9, 0.06);               // chin
  EXPECT_NEAR(at(33).y, 0.78, 0.03);             // nose base
  EXPECT_LT(at(30).z, at(51).z);                 // the nose tip is nearest,
  EXPECT_LT(at(51).z, at(8).z);                  // the lips before the chin,
  EXPECT_LT(at(8).z, at(0).z);                   // the ears behind
  EXPECT_NEAR(at(0).z, 0, 0.12);                 // in the middle of the head
}

TEST(GenericHead, TrianglesFaceTheViewerWithoutSlivers) {
  const Points points = moved({});
  for (const HeadTriangle& t : generic_head().triangles) {
    for (const int corner : t) {
      ASSERT_GE(corner, 0);
      ASSERT_LT(corner, kVertexCount);
    }
    EXPECT_GT(area(points, t), 0.002) << describe(t);
    EXPECT_GT(smallest_angle_deg(points, t), is_mouth_opening(t) ? 8 : 13) << describe(t);
  }
}

TEST(GenericHead, MirroredTrianglesExist) {
  std::set<std::set<int>> all;
  for (const HeadTriangle& t : generic_head().triangles) all.insert({t[0], t[1], t[2]});
  EXPECT_EQ(all.size(), generic_head().triangles.size());
  for (const HeadTriangle& t : generic_head().triangles) {
    EXPECT_TRUE(all.contains({vertex(t[0]).mirror, vertex(t[1]).mirror, vertex(t[2]).mirror})) << describe(t);
  }
}

TEST(GenericHead, IsADisk) {
  const std::map<Edge, int> edges = directed_edges();
  int border = 0;
  for (const auto& [edge, uses] : edges) {
    EXPECT_EQ(uses, 1) << vertex(edge.first).name << ", " << vertex(edge.second).name;
    border += edges.contains({edge.second, edge.first}) ? 0 : 1;
  }
  const int undirected = (static_cast<int>(edges.size()) + border) / 2;
  EXPECT_EQ(kVertexCount - undirected + static_cast<int>(generic_head().triangles.size()), 1);
  EXPECT_EQ(border, static_cast<int>(generic_head().outline.size()));

  std::set<int> reached{0};
  for (std::size_t before = 0; before != reached.size();) {
    before = reached.size();
    for (const auto& [edge, uses] : edges) {
      if (reached.contains(edge.first)) reached.insert(edge.second);
    }
  }
  EXPECT_EQ(reached.size(), static_cast<std::size_t>(kVertexCount));
}

TEST(GenericHead, OutlineIsOneClockwiseLoopOfBorderEdges) {
  const auto outline = generic_head().outline;
  const std::map<Edge, int> edges = directed_edges();
  const Points points = moved({});
  EXPECT_EQ(std::set<int>(outline.begin(), outline.end()).size(), outline.size());
  double twice_area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const int a = outline[i];
    const int b = outline[(i + 1) % outline.size()];
    EXPECT_TRUE(edges.contains({a, b}) && !edges.contains({b, a}))
        << vertex(a).name << ", " << vertex(b).name;
    twice_area += cross(points[a], points[b]);
  }
  EXPECT_GT(twice_area, 0);
}

TEST(GenericHead, FeaturesNameTheirVertices) {
  int next_control = 0;
  for (int f = 0; f < kFeatureCount; ++f) {
    const Feature& feature = generic_head().features[f];
    EXPECT_EQ(feature.first_control, next_control);
    next_control += feature.control_count;
    EXPECT_TRUE(std::is_sorted(feature.vertices.begin(), feature.vertices.end(),
                               [](const auto& a, const auto& b) { return a.s < b.s; }));
    for (const FeatureVertex& point : feature.vertices) {
      EXPECT_EQ(vertex(point.vertex).feature, f);
      EXPECT_GE(point.s, 0);
      EXPECT_LE(point.s, feature.closed ? static_cast<float>(feature.control_count) : 1.0F);
    }
  }
  EXPECT_EQ(next_control, kControlCount);
}

TEST(GenericHead, SkinningIsSymmetric) {
  for (int v = 0; v < kVertexCount; ++v) {
    std::map<int, int> mirrored;
    for (const auto& [control, weight] : weights(v)) mirrored[mirror_control(control)] = weight;
    EXPECT_EQ(mirrored, weights(vertex(v).mirror)) << vertex(v).name;
  }
}

TEST(GenericHead, SkinningWeightsAreInOrderAndInRange) {
  const GenericHead& head = generic_head();
  EXPECT_EQ(head.skinning_begin.front(), 0);
  EXPECT_EQ(head.skinning_begin.back(), head.skinning.size());
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    for (std::size_t i = head.skinning_begin[v]; i < head.skinning_begin[v + 1]; ++i) {
      EXPECT_GE(head.skinning[i].control, i > head.skinning_begin[v] ? head.skinning[i - 1].control + 1 : 0);
      EXPECT_LT(head.skinning[i].control, kControlCount);
      EXPECT_GE(head.skinning[i].weight, 16);
      EXPECT_LE(head.skinning[i].weight, kSkinningOne);
    }
  }
}

TEST(GenericHead, CurvesArePartitionsOfUnity) {
  using enum FeatureId;
  for (const FeatureId id : {kMouthOuter, kMouthInner, kBrowRight, kBrowLeft, kPupilRight, kPupilLeft}) {
    for (const FeatureVertex& point : feature(id).vertices) {
      EXPECT_EQ(weight_of(point.vertex, controls(id)), kSkinningOne) << vertex(point.vertex).name;
    }
  }
  for (const FeatureVertex& point :
       feature(kMouthInner).vertices) {  // the inner lips follow the outer ones completely
    EXPECT_EQ(weight_of(point.vertex, controls(kMouthOuter)), kSkinningOne) << vertex(point.vertex).name;
  }
}

TEST(GenericHead, SkinningWeightsAreTheBasisOfTheCurve) {
  for (const FeatureVertex& point : feature(FeatureId::kMouthOuter).vertices) {
    for (const auto& [control, weight] : weights(point.vertex)) {
      double t = std::abs(point.s - static_cast<float>(control));
      t = std::min(t, 10 - t);
      const double basis = t < 1 ? 2.0 / 3 - t * t + t * t * t / 2 : std::pow(2 - t, 3) / 6;
      EXPECT_NEAR(weight, basis * kSkinningOne, 4) << vertex(point.vertex).name;
    }
  }
}

TEST(GenericHead, UpperAndLowerLipShareNoControlPoint) {
  const std::set<int> upper{1, 2, 3, 4, 11, 12, 13};  // all but the corners' control points
  const std::set<int> lower{6, 7, 8, 9, 15, 16, 17};
  for (const int i : {31, 32, 33, 34, 35, 49, 50, 51, 52, 53, 61, 62, 63}) {
    EXPECT_EQ(weight_of(landmark(i), lower), 0) << vertex(landmark(i)).name;
  }
  for (const int i : {4, 5, 6, 7, 8, 9, 10, 11, 12, 55, 56, 57, 58, 59, 65, 66, 67}) {
    EXPECT_EQ(weight_of(landmark(i), upper), 0) << vertex(landmark(i)).name;
  }
}

TEST(GenericHead, EyeCornersEarsNoseAndHairlineStay) {
  std::set<int> still{landmark(28), landmark(29), landmark(30), landmark(36),
                      landmark(39), landmark(42), landmark(45)};
  for (const int v : generic_head().outline) {
    if (const int i = vertex(v).landmark; i < 4 || i > 12) still.insert(v);
  }
  for (const int v : still) EXPECT_TRUE(weights(v).empty()) << vertex(v).name;
}

TEST(GenericHead, ChinFollowsTheLowerLip) {
  EXPECT_NEAR(weight_of(landmark(8), range(6, 9)), 0.7 * kSkinningOne, 0.1 * kSkinningOne);
  EXPECT_LT(weight_of(landmark(4), range(6, 9)), weight_of(landmark(6), range(6, 9)));
}

TEST(GenericHead, LidsCloseWithoutFolding) {
  const std::array<std::array<int, 5>, 2> eyes{{{26, 37, 38, 41, 40}, {28, 43, 44, 47, 46}}};
  for (const double amount : {0.25, 0.5, 0.75, 0.95}) {
    Offsets offsets{};
    for (const auto& [first, upper_a, upper_b, lower_a, lower_b] : eyes) {
      const auto fall = [&](int upper, int lower) {
        return amount * (vertex(landmark(lower)).position.y - vertex(landmark(upper)).position.y) /
               kUnitsPerEyeDistance;
      };
      const double a = fall(upper_a, lower_a);  // = 4/9 of the first control point + 2/9 of the second
      const double b = fall(upper_b, lower_b);  // = 2/9 and 4/9
      offsets[first].y = 3 * a - 1.5 * b;
      offsets[static_cast<std::size_t>(first) + 1].y = 3 * b - 1.5 * a;
    }
    expect_nothing_folds(offsets);
  }
}

TEST(GenericHead, LipsPartWithoutFolding) {
  for (const double drop : {0.1, 0.2, 0.4}) {
    Offsets offsets{};
    for (std::size_t c = 6; c < 10; ++c) offsets[c].y = drop;
    expect_nothing_folds(offsets);
  }
}

TEST(GenericHead, SmilePuckerAndBrowsDoNotFold) {
  Offsets smile{};
  Offsets pucker{};
  for (const std::size_t c : {9, 0, 1}) {
    smile[c] = {-0.12, -0.06};
    pucker[c].x = 0.15;
  }
  for (const std::size_t c : {4, 5, 6}) {
    smile[c] = {0.12, -0.06};
    pucker[c].x = -0.15;
  }
  expect_nothing_folds(smile);
  expect_nothing_folds(pucker);
  for (const double rise : {-0.12, 0.25}) {
    Offsets brows{};
    for (std::size_t c = 18; c < 26; ++c) brows[c].y = -rise;
    expect_nothing_folds(brows);
  }
}

TEST(GenericHead, ExpressionPartsHoldEachControlPointOnce) {
  int next = 0;
  std::set<std::string> names;
  for (const ExpressionPart& part : generic_head().expression) {
    EXPECT_EQ(part.first_control, next);
    next += part.control_count;
    EXPECT_EQ(part.rows.size(), static_cast<std::size_t>(4 * part.control_count * part.control_count));
    names.emplace(part.name);
  }
  EXPECT_EQ(next, kControlCount);
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kExpressionPartCount));
}

/// |determinant| to the power of 1 / n of a part's basis.
double mean_stretch(const ExpressionPart& part) {
  const auto n = static_cast<std::size_t>(2 * part.control_count);
  std::vector<double> m(part.rows.begin(), part.rows.end());
  double log_sum = 0;
  for (std::size_t k = 0; k < n; ++k) {  // elimination with pivoting
    std::size_t pivot = k;
    for (std::size_t r = k; r < n; ++r)
      if (std::abs(m[r * n + k]) > std::abs(m[pivot * n + k])) pivot = r;
    if (m[pivot * n + k] == 0) return 0;
    for (std::size_t c = 0; c < n; ++c) std::swap(m[k * n + c], m[pivot * n + c]);
    log_sum += std::log(std::abs(m[k * n + k]) / kSkinningOne);
    for (std::size_t r = k + 1; r < n; ++r) {
      const double f = m[r * n + k] / m[k * n + k];
      for (std::size_t c = k; c < n; ++c) m[r * n + c] -= f * m[k * n + c];
    }
  }
  return std::exp(log_sum / static_cast<double>(n));
}

// Unusual expressions cost more bits, but all can be coded.
TEST(GenericHead, ExpressionBasisIsCompleteAndOfTheSizeOfControlPoints) {
  for (const ExpressionPart& part : generic_head().expression) {
    const double stretch = mean_stretch(part);
    EXPECT_TRUE(stretch > 0.2 && stretch < 1.01) << part.name << ' ' << stretch;
  }
}

// Neither side of the face is preferred: each direction is its own mirror image, or that with all signs
// changed.
TEST(GenericHead, ExpressionDirectionsAreEvenOrOdd) {
  for (const ExpressionPart& part : generic_head().expression) {
    const auto n = static_cast<std::size_t>(2 * part.control_count);
    for (std::size_t k = 0; k < n; ++k) {
      double even = 0, odd = 0, length = 0;
      for (int c = 0; c < part.control_count; ++c) {
        const int m = mirror_control(part.first_control + c) - part.first_control;
        ASSERT_TRUE(m >= 0 && m < part.control_count) << part.name;
        for (int axis = 0; axis < 2; ++axis) {
          const double own = part.rows[k * n + static_cast<std::size_t>(2 * c + axis)],
                       other =
                           (axis == 0 ? -1 : 1) * part.rows[k * n + static_cast<std::size_t>(2 * m + axis)];
          even += (own - other) * (own - other);
          odd += (own + other) * (own + other);
          length += own * own;
        }
      }
      EXPECT_LT(std::min(even, odd), 0.01 * length) << part.name << ' ' << k;
    }
  }
}

TEST(GenericHead, IsTheHeadOfTheFormat) {
  EXPECT_EQ(generic_head_hash(), 0x504F0440DE562CE4U);
}

}  // namespace
}  // namespace fbs
