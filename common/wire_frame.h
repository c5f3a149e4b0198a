// A wire-frame of a head: vertices, triangles, what they mean, and how control points move them. Paper
// section 2.1, Fig. 2. The generic head is one (generic_head.h); a stream may bring its own (SPEC 4.8).
//
// Head frame: x to the right of the picture (the subject's left), y down, z away from the viewer;
// right-handed. Origin: midway between the eye centres in x and y, in the middle of the head in z. Unit:
// 1/4096 of the generic head's eye distance. "right" and "left" in names are the subject's own.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "common/result.h"

namespace fbs {

inline constexpr int kLandmarkCount = 68;  ///< iBUG-68
inline constexpr int kUnitsPerEyeDistance = 4096;
inline constexpr int kControlCount = 36;   ///< control points of all features together
inline constexpr int kSkinningOne = 4096;  ///< a skinning weight of one

/// The feature that a control point belongs to, in the order of the stream (SPEC 5.1).
enum class FeatureId : std::uint8_t {
  kMouthOuter,     ///< closed cubic B-spline, 10 control points
  kMouthInner,     ///< closed cubic B-spline, 8 control points
  kBrowRight,      ///< clamped cubic B-spline, 4 control points, outer end first (landmarks 17..21)
  kBrowLeft,       ///< the same, inner end first (landmarks 22..26)
  kUpperLidRight,  ///< clamped cubic with 4 control points, of which the inner 2 are free (36..39)
  kUpperLidLeft,   ///< (42..45)
  kLowerLidRight,  ///< (39, 40, 41, 36)
  kLowerLidLeft,   ///< (45, 46, 47, 42)
  kPupilRight,     ///< one control point
  kPupilLeft,      ///< one control point
};
inline constexpr int kFeatureCount = 10;

/// A vertex on the curve of a feature.
struct FeatureVertex {
  std::uint16_t vertex;
  float s;  ///< curve parameter; closed: 0 <= s < control_count; clamped: 0..1; only the encoder uses it
};

struct Feature {
  std::string_view name;  ///< "mouth_outer", "brow_right", ...
  bool closed;
  std::uint16_t first_control;  ///< index into the state's control points
  std::uint16_t control_count;
  std::span<const FeatureVertex> vertices;  ///< in order of s
};

struct HeadVertex {
  std::string_view name;  ///< by anatomy: "nose_tip", "jaw_right_3"; may be empty
  glm::ivec3 position;    ///< head frame
  std::int16_t mirror;    ///< index of the mirror partner; itself on the midline
  std::int16_t landmark;  ///< 0..67, or -1
  std::int16_t feature;   ///< index of its feature, or -1
};

/// Vertex indices, clockwise in the picture when the head is seen from the front.
using HeadTriangle = std::array<std::uint16_t, 3>;

/// Weight of one control point at one vertex: vertex displacement += control offset * weight / kSkinningOne.
/// A fixed Gaussian of edge distance on the mesh (paper section 2.1).
struct SkinningWeight {
  std::uint16_t control;
  std::int16_t weight;
  friend bool operator==(const SkinningWeight&, const SkinningWeight&) = default;
};

/// Views of one head's tables, which are owned elsewhere.
struct WireFrame {
  std::span<const HeadVertex> vertices;
  std::span<const HeadTriangle> triangles;
  std::span<const std::uint16_t>
      outline;  ///< the mesh's border as a closed loop of vertices, clockwise in the picture
  std::array<Feature, kFeatureCount> features;
  std::span<const std::uint16_t> skinning_begin;  ///< weights of vertex v: [begin[v], begin[v+1])
  std::span<const SkinningWeight> skinning;
  std::span<const std::uint16_t, kLandmarkCount> landmark_vertex;  ///< vertex of each iBUG-68 point
  /// Where the vertices lie in the atlas, followed by the ring (decoder/atlas): one vertex for each of the
  /// outline, farther out. 1/4096 eye distance from the top left corner.
  std::span<const glm::ivec2> atlas;

  /// Control points that move a vertex.
  [[nodiscard]] std::span<const SkinningWeight> skinning_of(std::size_t vertex) const {
    return skinning.subspan(skinning_begin[vertex], skinning_begin[vertex + 1] - skinning_begin[vertex]);
  }
  /// @param ibug  0..67
  [[nodiscard]] std::size_t vertex_of_landmark(std::size_t ibug) const { return landmark_vertex[ibug]; }
  [[nodiscard]] const Feature& feature(FeatureId id) const { return features[static_cast<std::size_t>(id)]; }
  /// Right, then left.
  [[nodiscard]] std::array<std::size_t, 2> pupil_vertices() const {
    return {feature(FeatureId::kPupilRight).vertices.front().vertex,
            feature(FeatureId::kPupilLeft).vertices.front().vertex};
  }
};

inline constexpr std::size_t kMinWireFrameVertices = kLandmarkCount + 2;  ///< landmarks and pupils
inline constexpr std::size_t kMaxWireFrameVertices = 1024;
inline constexpr std::size_t kMaxWireFrameTriangles = 2 * kMaxWireFrameVertices;
inline constexpr std::size_t kMaxOutline = 256;                           ///< vertices
inline constexpr std::size_t kMaxFeatureVertices = 64;                    ///< on one feature
inline constexpr std::int32_t kMaxCoordinate = 4 * kUnitsPerEyeDistance;  ///< of a vertex, head units
inline constexpr std::int32_t kMaxAtlasCoordinate = 6 * kUnitsPerEyeDistance - 1;  ///< 0 is the smallest
/// Sum of the magnitudes of a vertex' skinning weights.
inline constexpr std::int32_t kMaxSkinningSum = 2 * kSkinningOne;

/// What a wire-frame other than the generic head is made from.
struct WireFrameTables {
  std::vector<glm::ivec3> positions;  ///< kMinWireFrameVertices..kMaxWireFrameVertices; within kMaxCoordinate
  std::array<std::uint16_t, kLandmarkCount> landmark_vertex{};  ///< all different
  /// Vertices on the curve of each feature, in order: at least one, a pupil exactly one; none in two
  /// features. The inner mouth begins at landmark 60, goes over the upper lip to landmark 64 and back.
  std::array<std::vector<std::uint16_t>, kFeatureCount> features;
  std::vector<HeadTriangle> triangles;  ///< 1..kMaxWireFrameTriangles; three different corners each
  std::vector<std::uint16_t> outline;   ///< 3..kMaxOutline, all different
  std::vector<std::vector<SkinningWeight>> skinning;  ///< of each vertex; controls ascend; no weight is 0
  std::vector<glm::ivec2> atlas;                      ///< vertices, then ring; 0..kMaxAtlasCoordinate
  friend bool operator==(const WireFrameTables&, const WireFrameTables&) = default;
};

/// @return kInvalidArgument  a rule above is broken
[[nodiscard]] Result<std::shared_ptr<const WireFrame>> make_wire_frame(const WireFrameTables& tables);

/// The reverse: the tables from which make_wire_frame() makes the same frame.
[[nodiscard]] WireFrameTables tables_of(const WireFrame& frame);

}  // namespace fbs
