#include "decoder/projection.h"

#include <algorithm>

#include "decoder/fixed_math.h"

namespace fbs {
namespace {

/// The ring lies this much farther from the head's axis than the outline in the seen pose, in 1/256.
constexpr std::int32_t kRingGrowth = 36;

constexpr std::int32_t kRingBehind = kUnitsPerEyeDistance / 2;  // head units

/// Below this determinant (Q14) of the seen pose's upper-left 2 x 2 rotation the surround stays still: the
/// head is seen from the side and its plane cannot be inverted.
constexpr std::int64_t kMinSeenDeterminant = 1 << 11;

std::int32_t clamp_screen(std::int64_t v) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(v, -kMaxScreen, kMaxScreen));
}

/// Keeps the pupil's vertex between the lids, a quarter of the gap from either: a shutting eye would fold its
/// triangles otherwise.
void keep_between_lids(std::array<glm::ivec3, kVertexCount>& vertices, FeatureId upper_lid,
                       FeatureId lower_lid, FeatureId pupil) {
  const auto y_of = [&](const FeatureVertex& v) { return vertices[static_cast<std::size_t>(v.vertex)].y; };
  std::int32_t upper = INT32_MIN, lower = INT32_MAX;
  for (const FeatureVertex& v : feature(upper_lid).vertices) upper = std::max(upper, y_of(v));
  for (const FeatureVertex& v : feature(lower_lid).vertices) lower = std::min(lower, y_of(v));
  std::int32_t& y = vertices[static_cast<std::size_t>(feature(pupil).vertices.front().vertex)].y;
  const std::int32_t margin = (lower - upper) / 4;
  y = lower > upper ? std::clamp(y, upper + margin, lower - margin) : upper + (lower - upper) / 2;
}

HeadMesh make_head_mesh() {
  const GenericHead& head = generic_head();
  HeadMesh mesh;
  mesh.triangles.assign(head.triangles.begin(), head.triangles.end());
  const std::size_t n = head.outline.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const std::int16_t a = head.outline[i], b = head.outline[j];
    const auto ring_a = static_cast<std::int16_t>(kVertexCount + i);
    const auto ring_b = static_cast<std::int16_t>(kVertexCount + j);
    mesh.triangles.push_back({a, ring_a, ring_b});
    mesh.triangles.push_back({a, ring_b, b});
  }
  mesh.vertex_count = kVertexCount + static_cast<int>(n);
  return mesh;
}

}  // namespace

HeadPose dequantise_pose(const State& state, const QuantiserSteps& steps) {
  return {state.pose[kPitch] * steps.rotation,     state.pose[kYaw] * steps.rotation,
          state.pose[kRoll] * steps.rotation,      state.pose[kShiftX] * steps.translation,
          state.pose[kShiftY] * steps.translation, state.pose[kLogScale] * steps.log_scale};
}

HeadProjection::HeadProjection(const HeadPose& pose)
    : scale(exp2_q16(pose.log_scale)), shift(pose.shift_x, pose.shift_y) {
  const std::int64_t sp = sine(pose.pitch), cp = cosine(pose.pitch);
  const std::int64_t sy = sine(pose.yaw), cy = cosine(pose.yaw);
  const std::int64_t sr = sine(pose.roll), cr = cosine(pose.roll);
  const auto q = [](std::int64_t product) { return round_shift(product, kRotationOneLog2); };
  const std::int64_t sysp = q(sy * sp), sycp = q(sy * cp);
  const auto i = [](std::int64_t v) { return static_cast<std::int32_t>(v); };
  rotation = {{{i(q(cr * cy)), i(q(cr * sysp - sr * cp)), i(q(cr * sycp + sr * sp))},
               {i(q(sr * cy)), i(q(sr * sysp + cr * cp)), i(q(sr * sycp - cr * sp))},
               {i(-sy), i(q(cy * sp)), i(q(cy * cp))}}};
}

glm::ivec3 HeadProjection::operator()(glm::ivec3 p) const {
  const auto turned = [&](const std::array<std::int32_t, 3>& row) {
    return round_shift(std::int64_t{row[0]} * p.x + std::int64_t{row[1]} * p.y + std::int64_t{row[2]} * p.z,
                       kRotationOneLog2);
  };
  constexpr int kToScreen = kScaleOneLog2 + 12 - kScreenOneLog2;  // head units are 2^-12 eye distances
  return {clamp_screen(shift.x + round_shift(scale * turned(rotation[0]), kToScreen)),
          clamp_screen(shift.y + round_shift(scale * turned(rotation[1]), kToScreen)),
          static_cast<std::int32_t>(turned(rotation[2]))};
}

std::array<glm::ivec3, kVertexCount> deform(const std::array<glm::ivec3, kVertexCount>& neutral,
                                            const State& state, const QuantiserSteps& steps) {
  const GenericHead& head = generic_head();
  std::array<glm::ivec3, kVertexCount> out = neutral;
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    std::int64_t x = 0, y = 0;
    for (std::size_t k = head.spread_begin[v]; k < head.spread_begin[v + 1]; ++k) {
      const glm::ivec2 c = state.control[static_cast<std::size_t>(head.spread[k].control)];
      x += std::int64_t{head.spread[k].weight} * c.x;
      y += std::int64_t{head.spread[k].weight} * c.y;
    }
    out[v].x += static_cast<std::int32_t>(round_shift(x * steps.control, 12));
    out[v].y += static_cast<std::int32_t>(round_shift(y * steps.control, 12));
  }
  static_assert(kSpreadOne == 1 << 12);
  keep_between_lids(out, FeatureId::kUpperLidRight, FeatureId::kLowerLidRight, FeatureId::kPupilRight);
  keep_between_lids(out, FeatureId::kUpperLidLeft, FeatureId::kLowerLidLeft, FeatureId::kPupilLeft);
  return out;
}

std::int32_t mouth_shade(std::int32_t gap_now, std::int32_t gap_seen) {
  constexpr std::int32_t kPartedWholly = kUnitsPerEyeDistance / 16;
  static_assert(kPartedWholly == 256);
  return std::clamp(gap_now - gap_seen, 0, kPartedWholly);
}

std::int32_t mouth_gap(const std::array<glm::ivec3, kVertexCount>& vertices) {
  const auto y_of = [&](std::size_t landmark) {
    return vertices[static_cast<std::size_t>(generic_head().landmark_vertex[landmark])].y;
  };
  return y_of(66) - y_of(62);
}

bool is_inner_lip(std::int16_t vertex) {
  return vertex < kVertexCount && generic_head().vertices[static_cast<std::size_t>(vertex)].landmark >= 60;
}

std::int32_t mouth_ramp(std::int16_t inner_lip_vertex) {
  const int landmark = generic_head().vertices[static_cast<std::size_t>(inner_lip_vertex)].landmark;
  return landmark == 60 || landmark == 64 ? 128 : landmark < 64 ? 0 : 256;
}

const HeadMesh& head_mesh() {
  static const HeadMesh mesh = make_head_mesh();
  return mesh;
}

SceneGeometry::SceneGeometry(const Setup& setup, const Geometry& geometry, SurroundMap surround,
                             const State& seen)
    : steps_(setup.steps),
      width_(setup.format.width),
      height_(setup.format.height),
      geometry_(geometry),
      surround_(std::move(surround)),
      seen_(dequantise_pose(seen, setup.steps)) {
  const HeadProjection projection(seen_);
  for (const std::int16_t v : generic_head().outline) {
    const glm::ivec3 p = geometry_.positions[static_cast<std::size_t>(v)];
    const glm::ivec3 at = projection({p.x + p.x * kRingGrowth / 256, p.y + p.y * kRingGrowth / 256, p.z});
    ring_.push_back(place_ring_vertex({at.x, at.y}));
  }
}

glm::ivec2 SceneGeometry::regular(int column, int row) const {
  const auto share = [](int size, int k, int of) {
    return static_cast<std::int32_t>((std::int64_t{size} << kScreenOneLog2) * k / of);
  };
  return {share(width_, column, surround_.columns), share(height_, row, surround_.rows)};
}

SceneGeometry::RingVertex SceneGeometry::place_ring_vertex(glm::ivec2 seen) const {
  const glm::ivec2 last = regular(surround_.columns, surround_.rows);
  const glm::ivec2 inside(std::clamp(seen.x, 0, last.x), std::clamp(seen.y, 0, last.y));
  RingVertex r{seen, 0, 0, 0, 0};
  while (r.column + 1 < surround_.columns && regular(r.column + 1, 0).x <= inside.x) ++r.column;
  while (r.row + 1 < surround_.rows && regular(0, r.row + 1).y <= inside.y) ++r.row;
  const glm::ivec2 low = regular(r.column, r.row), high = regular(r.column + 1, r.row + 1);
  r.across = (inside.x - low.x) * 256 / (high.x - low.x);
  r.down = (inside.y - low.y) * 256 / (high.y - low.y);
  return r;
}

void SceneGeometry::project_ring(const HeadProjection& projection, ScreenMesh& mesh) const {
  const int stride = surround_.columns + 1;
  for (std::size_t i = 0; i < ring_.size(); ++i) {
    const RingVertex& r = ring_[i];
    const auto moved = [&](int column, int row) {
      return mesh.surround[static_cast<std::size_t>(row * stride + column)] - regular(column, row);
    };
    const glm::ivec2 a = moved(r.column, r.row), b = moved(r.column + 1, r.row);
    const glm::ivec2 c = moved(r.column, r.row + 1), d = moved(r.column + 1, r.row + 1);
    const auto blend = [&](std::int64_t va, std::int64_t vb, std::int64_t vc, std::int64_t vd) {
      const std::int64_t top = va * (256 - r.across) + vb * r.across,
                         bottom = vc * (256 - r.across) + vd * r.across;
      return static_cast<std::int32_t>(round_shift(top * (256 - r.down) + bottom * r.down, 16));
    };
    // Behind the outline, so that the face hides it where the head has moved over it.
    glm::ivec3 p = geometry_.positions[static_cast<std::size_t>(generic_head().outline[i])];
    p.z += kRingBehind;
    mesh.head.emplace_back(clamp_screen(r.seen.x + blend(a.x, b.x, c.x, d.x)),
                           clamp_screen(r.seen.y + blend(a.y, b.y, c.y, d.y)), projection(p).z);
  }
}

std::array<glm::ivec3, kVertexCount> SceneGeometry::project_vertices(const State& state) const {
  const HeadProjection projection(dequantise_pose(state, steps_));
  std::array<glm::ivec3, kVertexCount> points = deform(geometry_.positions, state, steps_);
  for (glm::ivec3& p : points) p = projection(p);
  return points;
}

ScreenMesh SceneGeometry::project(const State& state) const {
  const HeadPose pose = dequantise_pose(state, steps_);
  const HeadProjection projection(pose);
  ScreenMesh mesh;
  const auto vertices = deform(geometry_.positions, state, steps_);
  for (const glm::ivec3& v : vertices) mesh.head.push_back(projection(v));
  mesh.mouth_gap = mouth_gap(vertices);
  project_surround(pose, mesh.surround);
  project_ring(projection, mesh);
  return mesh;
}

void SceneGeometry::project_surround(const HeadPose& pose, std::vector<glm::ivec2>& out) const {
  // A point of the surround lies in the head frame's plane z = 0. There the way from the seen pose to this
  // one is affine: p -> m (p - seen.shift) + shift, with m = now * seen^-1, both scale * upper-left 2 x 2 of
  // the rotation.
  const HeadProjection seen(seen_), now(pose);
  const auto& a = now.rotation;
  const auto& b = seen.rotation;
  const std::int64_t det = round_shift(std::int64_t{b[0][0]} * b[1][1] - std::int64_t{b[0][1]} * b[1][0], 14);
  const bool moves = det >= kMinSeenDeterminant && !(pose == seen_);
  std::int64_t m[2][2] = {{1 << 16, 0}, {0, 1 << 16}};  // Q16
  if (moves) {
    const std::int64_t ratio = (now.scale << 16) / seen.scale;                      // Q16
    const std::int64_t inverse[2][2] = {{b[1][1], -b[0][1]}, {-b[1][0], b[0][0]}};  // times 1 / det
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const std::int64_t q14 = (a[i][0] * inverse[0][j] + a[i][1] * inverse[1][j]) / det;
        m[i][j] = std::clamp<std::int64_t>(round_shift(q14 * ratio, 14), -(1 << 20), 1 << 20);
      }
  }
  const int columns = surround_.columns, rows = surround_.rows;
  out.resize(static_cast<std::size_t>(columns + 1) * static_cast<std::size_t>(rows + 1));
  std::size_t k = 0;
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c, ++k) {
      glm::ivec2 p = regular(c, r);
      const int follow = surround_.follow[k];
      const bool border = r == 0 || c == 0 || r == rows || c == columns;
      if (moves && follow > 0 && !border) {
        const std::int64_t dx = p.x - seen.shift.x, dy = p.y - seen.shift.y;
        const std::int64_t px = now.shift.x + round_shift(m[0][0] * dx + m[0][1] * dy, 16);
        const std::int64_t py = now.shift.y + round_shift(m[1][0] * dx + m[1][1] * dy, 16);
        p.x = clamp_screen(p.x + (px - p.x) * follow / kFollowOne);
        p.y = clamp_screen(p.y + (py - p.y) * follow / kFollowOne);
      }
      out[k] = p;
    }
  }
}

}  // namespace fbs
