#include "bitstream/payload/geometry_payload.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <utility>

#include "bitstream/byte_io.h"
#include "bitstream/payload/draco_points.h"

namespace fbs {
namespace {

constexpr int kScaleShift = 12;
constexpr std::int64_t kMaxScale = 16 << kScaleShift;
constexpr std::int32_t kMaxResidual = 1 << 20;  // steps, of either sign

/// How the residual of a vertex is predicted from those before it. SPEC 4.2.
enum class Prediction : std::uint8_t { kNone = 0, kNeighbours = 1, kMirror = 2 };
constexpr std::array kPredictions = {Prediction::kNone, Prediction::kNeighbours, Prediction::kMirror};

/// Which scaled head the residuals belong to.
struct ScaledHead {
  const WireFrame& head;
  std::array<std::int32_t, 3> scale{};  // per axis, 1/4096
  std::int32_t step = 1;                // head units
};

using Scaled = std::array<std::int64_t, 3>;

// SPEC 4.2: position times scale, rounded half up.
Scaled scaled_vertex(const ScaledHead& frame, std::size_t vertex) {
  const glm::ivec3 p = frame.head.vertices[vertex].position;
  const auto scaled = [](std::int64_t value, std::int64_t scale) {
    return (value * scale + (1 << (kScaleShift - 1))) >> kScaleShift;
  };
  return {scaled(p.x, frame.scale[0]), scaled(p.y, frame.scale[1]), scaled(p.z, frame.scale[2])};
}

/// For each vertex its neighbours of smaller index, by the edges of the mesh.
class EarlierNeighbours {
 public:
  explicit EarlierNeighbours(const WireFrame& head) : lists_(head.vertices.size()) {
    for (const HeadTriangle& t : head.triangles) {
      for (std::size_t i = 0; i < 3; ++i) add(t[i], t[(i + 1) % 3]);
    }
  }
  [[nodiscard]] std::span<const std::int16_t> of(std::size_t vertex) const { return lists_[vertex]; }

 private:
  void add(std::int16_t a, std::int16_t b) {
    auto& list = lists_[std::max(a, b)];
    const std::int16_t earlier = std::min(a, b);
    if (std::find(list.begin(), list.end(), earlier) == list.end()) list.push_back(earlier);
  }
  std::vector<std::vector<std::int16_t>> lists_;
};

glm::ivec3 predicted(const WireFrame& head, const HeadPoints& residuals, std::size_t vertex,
                     Prediction prediction, const EarlierNeighbours& neighbours) {
  if (prediction == Prediction::kMirror) {
    const std::size_t mirror = head.vertices[vertex].mirror;
    if (mirror >= vertex) return {0, 0, 0};
    const glm::ivec3 r = residuals[mirror];
    return {-r.x, r.y, r.z};
  }
  const auto earlier = neighbours.of(vertex);
  if (prediction == Prediction::kNone || earlier.empty()) return {0, 0, 0};
  glm::ivec3 sum{0, 0, 0};
  for (const std::int16_t v : earlier) sum += residuals[v];
  return sum / static_cast<std::int32_t>(earlier.size());  // truncated
}

// Least squares of each axis; one where the wire-frame has no extent.
std::int32_t fitted_scale(const Geometry& geometry, int axis) {
  std::int64_t product = 0;
  std::int64_t squared = 0;
  for (std::size_t v = 0; v < geometry.positions.size(); ++v) {
    const std::int64_t unscaled = geometry.wire_frame().vertices[v].position[axis];
    product += unscaled * geometry.positions[v][axis];
    squared += unscaled * unscaled;
  }
  if (squared == 0) return 1 << kScaleShift;
  const std::int64_t scale = ((product << kScaleShift) + squared / 2) / squared;
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(scale, 1, kMaxScale));
}

// The multiple of `step` from `from` that is nearest to `to` and stays within kMaxCoordinate.
std::int32_t quantised(std::int64_t to, std::int64_t from, std::int64_t step) {
  const std::int64_t difference = to - from;
  std::int64_t steps = (std::abs(difference) + step / 2) / step;
  if (difference < 0) steps = -steps;
  const std::int64_t reached = from + steps * step;
  if (reached > kMaxCoordinate) --steps;
  if (reached < -kMaxCoordinate) ++steps;
  return static_cast<std::int32_t>(steps);
}

std::optional<std::vector<glm::ivec3>> reconstruct(const ScaledHead& frame, const HeadPoints& residuals) {
  std::vector<glm::ivec3> positions(residuals.size());
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Scaled scaled = scaled_vertex(frame, v);
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t value = scaled[axis] + std::int64_t{residuals[v][axis]} * frame.step;
      if (std::abs(value) > kMaxCoordinate) return std::nullopt;
      positions[v][axis] = static_cast<std::int32_t>(value);
    }
  }
  return positions;
}

bool vertices_in_range(const Geometry& geometry) {
  return std::all_of(geometry.positions.begin(), geometry.positions.end(), [](const glm::ivec3& p) {
    const auto inside = [](std::int32_t c) { return c >= -kMaxCoordinate && c <= kMaxCoordinate; };
    return inside(p.x) && inside(p.y) && inside(p.z);
  });
}

Result<std::vector<std::uint8_t>> write_payload(const ScaledHead& frame, const HeadPoints& residuals,
                                                Prediction prediction) {
  const EarlierNeighbours neighbours(frame.head);
  HeadPoints coded(residuals.size());
  for (std::size_t v = 0; v < coded.size(); ++v) {
    coded[v] = residuals[v] - predicted(frame.head, residuals, v, prediction, neighbours);
  }
  const auto points = encode_points(coded);
  if (!points) return fail(points.error());
  std::vector<std::uint8_t> payload;
  ByteWriter writer(payload);
  for (const std::int32_t scale : frame.scale) writer.varint(static_cast<std::uint64_t>(scale));
  writer.varint(static_cast<std::uint64_t>(frame.step));
  writer.u8(static_cast<std::uint8_t>(prediction));
  writer.bytes(*points);
  return payload;
}

// SPEC 4.2: residuals in the order of the vertices, each predicted from earlier vertices.
std::optional<HeadPoints> undo_prediction(const WireFrame& head, const HeadPoints& coded,
                                          Prediction prediction) {
  const EarlierNeighbours neighbours(head);
  HeadPoints residuals(coded.size());
  for (std::size_t v = 0; v < residuals.size(); ++v) {
    const glm::ivec3 from = predicted(head, residuals, v, prediction, neighbours);
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t value = std::int64_t{from[axis]} + coded[v][axis];
      if (std::abs(value) > kMaxResidual) return std::nullopt;
      residuals[v][axis] = static_cast<std::int32_t>(value);
    }
  }
  return residuals;
}

}  // namespace

bool is_flat(const Geometry& geometry) {
  constexpr std::int32_t kDepth = kUnitsPerEyeDistance / 64;  // a tenth of the depth of the flattest face
  return std::all_of(geometry.positions.begin(), geometry.positions.end(),
                     [](const glm::ivec3& p) { return std::abs(p.z) < kDepth; });
}

Result<CodedGeometry> encode_geometry(const Geometry& geometry, std::int32_t step) {
  if (step < 1 || step > kMaxGeometryStep)
    return fail(ErrorCode::kInvalidArgument, "geometry step is out of range");
  const WireFrame& head = geometry.wire_frame();
  if (geometry.positions.size() != head.vertices.size())
    return fail(ErrorCode::kInvalidArgument, "geometry has another number of vertices than its wire-frame");
  if (!vertices_in_range(geometry)) return fail(ErrorCode::kInvalidArgument, "a vertex is out of range");

  const ScaledHead frame{
      head, {fitted_scale(geometry, 0), fitted_scale(geometry, 1), fitted_scale(geometry, 2)}, step};
  HeadPoints residuals(head.vertices.size());
  for (std::size_t v = 0; v < residuals.size(); ++v) {
    const Scaled scaled = scaled_vertex(frame, v);
    for (int axis = 0; axis < 3; ++axis) {
      residuals[v][axis] = quantised(geometry.positions[v][axis], scaled[axis], step);
    }
  }
  auto decoded = reconstruct(frame, residuals);
  if (!decoded) return fail(ErrorCode::kInternal, "a quantised vertex is out of range");

  CodedGeometry best{{}, {std::move(*decoded), geometry.own_frame}};
  for (const Prediction prediction : kPredictions) {
    if (prediction == Prediction::kMirror && geometry.own_frame) continue;
    auto payload = write_payload(frame, residuals, prediction);
    if (!payload) return fail(payload.error());
    if (best.payload.empty() || payload->size() < best.payload.size()) best.payload = std::move(*payload);
  }
  return best;
}

Result<Geometry> decode_geometry(std::span<const std::uint8_t> payload,
                                 std::shared_ptr<const WireFrame> own_frame) {
  if (payload.size() > kMaxGeometryPayload) return fail(ErrorCode::kTooLarge, "geometry packet is too large");

  // SPEC 4.2
  ByteReader reader(payload);
  std::array<std::uint64_t, 3> scale{};
  for (auto& s : scale) s = reader.varint();
  const std::uint64_t step = reader.varint();
  const std::uint8_t prediction = reader.u8();
  if (reader.past_end()) return fail(ErrorCode::kTruncated, "geometry packet ends early");
  const auto is_scale = [](std::uint64_t s) { return s >= 1 && s <= kMaxScale; };
  if (reader.malformed() || !std::all_of(scale.begin(), scale.end(), is_scale) || step < 1 ||
      step > kMaxGeometryStep || prediction >= kPredictions.size()) {
    return fail(ErrorCode::kInvalidStream, "geometry packet has a damaged header");
  }
  const WireFrame& head = own_frame ? *own_frame : generic_head();
  const auto coded = decode_points(reader.rest(), head.vertices.size());
  if (!coded) return fail(coded.error());

  const auto residuals = undo_prediction(head, *coded, Prediction{prediction});
  if (!residuals) return fail(ErrorCode::kInvalidStream, "a vertex is out of range");
  const ScaledHead frame{head,
                         {static_cast<std::int32_t>(scale[0]), static_cast<std::int32_t>(scale[1]),
                          static_cast<std::int32_t>(scale[2])},
                         static_cast<std::int32_t>(step)};
  auto positions = reconstruct(frame, *residuals);
  if (!positions) return fail(ErrorCode::kInvalidStream, "a vertex is out of range");
  return Geometry{std::move(*positions), std::move(own_frame)};
}

}  // namespace fbs
