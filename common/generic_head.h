// The generic head: 105 vertices, their triangles, and how control points move them. Paper section 2.1,
// Fig. 2.
//
// Its source is common/generic_head.gltf (made by common/author_generic_head.py; our own drawing, with the
// published roles of CANDIDE's vertices). common/head_table_tool.cpp turns it into
// common/generic_head_table.cpp. The tables are integers and part of the format: SPEC.md gives their hash.
//
// Head frame: x to the right of the picture (the subject's left), y down, z away from the viewer;
// right-handed. Origin: midway between the eye centres in x and y, in the middle of the head in z. Unit:
// 1/4096 of the generic head's eye distance. "right" and "left" in names are the subject's own.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

namespace fbs {

inline constexpr int kVertexCount = 105;
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
  std::span<const FeatureVertex> vertices;  ///< in order of s; empty for none
};

struct HeadVertex {
  std::string_view name;  ///< by anatomy: "nose_tip", "jaw_right_3"
  glm::ivec3 position;    ///< head frame
  std::int16_t mirror;    ///< index of the mirror partner; itself on the midline
  std::int16_t landmark;  ///< 0..67, or -1
  std::int16_t feature;   ///< index of its feature, or -1
};

/// Vertex indices, clockwise in the picture when the head is seen from the front.
using HeadTriangle = std::array<std::uint16_t, 3>;

/// Weight of one control point at one vertex: vertex displacement += control offset * weight / kSkinningOne.
/// A fixed Gaussian of edge distance on the generic mesh (paper section 2.1).
struct SkinningWeight {
  std::uint16_t control;
  std::int16_t weight;
};

/// A part of the face and the basis of its expression: row k of `rows` is what one unit of coefficient k adds
/// to the control points of the part, x0, y0, x1, y1 ..., in 1/kSkinningOne. The basis is complete and sorted
/// by variance, largest first (author_expression_basis.py).
struct ExpressionPart {
  std::string_view name;  ///< "mouth", "brows", "upper_lids", "lower_lids", "gaze"
  std::uint16_t first_control;
  std::uint16_t control_count;
  std::span<const std::int16_t> rows;  ///< 2 * control_count rows of as many
};
inline constexpr int kExpressionPartCount = 5;

/// The tables, valid as long as the program runs. No allocation.
struct GenericHead {
  std::span<const HeadVertex, kVertexCount> vertices;
  std::span<const HeadTriangle> triangles;
  std::span<const std::uint16_t>
      outline;  ///< the mesh's border as a closed loop of vertices, clockwise in the picture
  std::array<Feature, kFeatureCount> features;
  std::span<const std::uint16_t, kVertexCount + 1>
      skinning_begin;  ///< weights of vertex v: [begin[v], begin[v+1])
  std::span<const SkinningWeight> skinning;
  std::span<const std::uint16_t, kLandmarkCount> landmark_vertex;  ///< vertex of each iBUG-68 point
  std::array<ExpressionPart, kExpressionPartCount> expression;
};

[[nodiscard]] const GenericHead& generic_head();

/// FNV-1a (64 bits: basis 0xCBF29CE484222325, prime 0x100000001B3) of the head's integers, each as 4 bytes,
/// two's complement, little-endian, in this order; it equals the constant in SPEC.md.
///   105; for each vertex: x, y, z, mirror, landmark, feature
///   number of triangles; for each: three corners
///   length of the outline; its vertices
///   10; for each feature: closed (0 or 1), first control, number of controls, number of vertices, its
///   vertices
///   for each vertex: number of skinning weights; for each: control, weight (controls ascend)
///   5; for each part of the expression: first control, number of controls, the rows
[[nodiscard]] std::uint64_t generic_head_hash();

[[nodiscard]] inline const Feature& feature(FeatureId id) {
  return generic_head().features[static_cast<std::size_t>(id)];
}

/// Control points that move a vertex.
[[nodiscard]] inline std::span<const SkinningWeight> skinning_of(std::size_t vertex) {
  const GenericHead& head = generic_head();
  return head.skinning.subspan(head.skinning_begin[vertex],
                               head.skinning_begin[vertex + 1] - head.skinning_begin[vertex]);
}

/// @param ibug  0..67
[[nodiscard]] inline std::size_t vertex_of_landmark(std::size_t ibug) {
  return generic_head().landmark_vertex[ibug];
}

}  // namespace fbs
