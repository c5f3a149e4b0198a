#include "common/wire_frame.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "common/generic_head.h"

namespace fbs {
namespace {

constexpr std::size_t kMouthInner = static_cast<std::size_t>(FeatureId::kMouthInner);
constexpr std::size_t kFirstPupil = static_cast<std::size_t>(FeatureId::kPupilRight);
constexpr std::size_t kRightMouthCorner = 60, kLeftMouthCorner = 64;  // landmarks

/// A WireFrame and the tables it views.
struct Kept {
  std::vector<HeadVertex> vertices;
  std::vector<HeadTriangle> triangles;
  std::vector<std::uint16_t> outline, skinning_begin;
  std::array<std::vector<FeatureVertex>, kFeatureCount> features;
  std::vector<SkinningWeight> skinning;
  std::array<std::uint16_t, kLandmarkCount> landmark_vertex{};
  std::vector<glm::ivec2> atlas;
  std::unique_ptr<const WireFrame> frame;
};

template <class Range>
bool different(const Range& range, std::size_t below) {
  std::vector<bool> seen(below);
  for (const std::size_t v : range) {
    if (v >= below || seen[v]) return false;
    seen[v] = true;
  }
  return true;
}

bool right_features(const WireFrameTables& t) {
  std::vector<std::uint16_t> all;
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    const std::size_t n = t.features[f].size(), most = f >= kFirstPupil ? 1 : kMaxFeatureVertices;
    if (n < 1 || n > most) return false;
    all.insert(all.end(), t.features[f].begin(), t.features[f].end());
  }
  const std::vector<std::uint16_t>& mouth = t.features[kMouthInner];
  return different(all, t.positions.size()) && mouth.front() == t.landmark_vertex[kRightMouthCorner] &&
         std::find(mouth.begin(), mouth.end(), t.landmark_vertex[kLeftMouthCorner]) != mouth.end();
}

bool right_skinning(const std::vector<SkinningWeight>& weights) {
  std::int32_t sum = 0, last = -1;
  for (const SkinningWeight& s : weights) {
    if (s.control <= last || s.control >= kControlCount || s.weight == 0) return false;
    last = s.control;
    sum += std::abs(std::int32_t{s.weight});
  }
  return sum <= kMaxSkinningSum;
}

bool within(std::int32_t value, std::int32_t low, std::int32_t high) {
  return value >= low && value <= high;
}

/// The first rule broken; null if none.
const char* fault(const WireFrameTables& t) {
  const std::size_t n = t.positions.size();
  if (n < kMinWireFrameVertices || n > kMaxWireFrameVertices) return "has 70 to 1024 vertices";
  for (const glm::ivec3& p : t.positions)
    for (int axis = 0; axis < 3; ++axis)
      if (!within(p[axis], -kMaxCoordinate, kMaxCoordinate)) return "has a vertex out of range";
  if (!different(t.landmark_vertex, n)) return "needs a vertex of its own for each of 68 landmarks";
  if (!right_features(t)) return "has a feature with wrong vertices";
  if (t.triangles.empty() || t.triangles.size() > kMaxWireFrameTriangles) return "has 1 to 2048 triangles";
  for (const HeadTriangle& triangle : t.triangles)
    if (!different(triangle, n)) return "has a triangle with wrong corners";
  if (t.outline.size() < 3 || t.outline.size() > kMaxOutline || !different(t.outline, n))
    return "has an outline of 3 to 256 different vertices";
  if (t.skinning.size() != n || !std::all_of(t.skinning.begin(), t.skinning.end(), right_skinning))
    return "has wrong skinning weights";
  if (t.atlas.size() != n + t.outline.size())
    return "needs a place in the atlas for each vertex and the ring";
  for (const glm::ivec2& p : t.atlas)
    if (!within(p.x, 0, kMaxAtlasCoordinate) || !within(p.y, 0, kMaxAtlasCoordinate))
      return "has a place in the atlas out of range";
  return nullptr;
}

/// Parameters of the vertices on the curve, at equal distances.
std::vector<FeatureVertex> on_curve(const std::vector<std::uint16_t>& vertices, const Feature& kind) {
  std::vector<FeatureVertex> out;
  const auto n = static_cast<float>(vertices.size());
  for (const std::uint16_t v : vertices) {
    const auto k = static_cast<float>(out.size());
    out.push_back({v, kind.closed ? k * static_cast<float>(kind.control_count) / n : (k + 0.5F) / n});
  }
  return out;
}

void name_vertices(const WireFrameTables& t, Kept& out) {
  for (std::size_t v = 0; v < t.positions.size(); ++v)
    out.vertices.push_back({{}, t.positions[v], static_cast<std::int16_t>(v), -1, -1});
  for (std::size_t k = 0; k < t.landmark_vertex.size(); ++k)
    out.vertices[t.landmark_vertex[k]].landmark = static_cast<std::int16_t>(k);
  for (std::size_t f = 0; f < kFeatureCount; ++f)
    for (const std::uint16_t v : t.features[f]) out.vertices[v].feature = static_cast<std::int16_t>(f);
}

}  // namespace

Result<std::shared_ptr<const WireFrame>> make_wire_frame(const WireFrameTables& tables) {
  if (const char* const wrong = fault(tables))
    return fail(ErrorCode::kInvalidArgument, std::string("a wire-frame ") + wrong);
  const auto kept = std::make_shared<Kept>();
  name_vertices(tables, *kept);
  kept->triangles = tables.triangles;
  kept->outline = tables.outline;
  kept->landmark_vertex = tables.landmark_vertex;
  kept->atlas = tables.atlas;
  kept->skinning_begin.push_back(0);
  for (const std::vector<SkinningWeight>& weights : tables.skinning) {
    kept->skinning.insert(kept->skinning.end(), weights.begin(), weights.end());
    kept->skinning_begin.push_back(static_cast<std::uint16_t>(kept->skinning.size()));
  }
  std::array<Feature, kFeatureCount> features;
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    const Feature& kind = generic_head().features[f];
    kept->features[f] = on_curve(tables.features[f], kind);
    features[f] = {kind.name, kind.closed, kind.first_control, kind.control_count, kept->features[f]};
  }
  kept->frame = std::make_unique<const WireFrame>(WireFrame{kept->vertices, kept->triangles, kept->outline,
                                                            features, kept->skinning_begin, kept->skinning,
                                                            kept->landmark_vertex, kept->atlas});
  return std::shared_ptr<const WireFrame>(kept, kept->frame.get());
}

WireFrameTables tables_of(const WireFrame& frame) {
  WireFrameTables out;
  for (const HeadVertex& v : frame.vertices) out.positions.push_back(v.position);
  std::copy(frame.landmark_vertex.begin(), frame.landmark_vertex.end(), out.landmark_vertex.begin());
  for (std::size_t f = 0; f < kFeatureCount; ++f)
    for (const FeatureVertex& v : frame.features[f].vertices) out.features[f].push_back(v.vertex);
  out.triangles.assign(frame.triangles.begin(), frame.triangles.end());
  out.outline.assign(frame.outline.begin(), frame.outline.end());
  for (std::size_t v = 0; v < frame.vertices.size(); ++v) {
    const auto weights = frame.skinning_of(v);
    out.skinning.emplace_back(weights.begin(), weights.end());
  }
  out.atlas.assign(frame.atlas.begin(), frame.atlas.end());
  return out;
}

}  // namespace fbs
