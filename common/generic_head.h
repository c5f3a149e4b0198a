// The generic head: 105 vertices, their triangles, and how control points move them. Paper section 2.1,
// Fig. 2.
//
// The source is common/generic_head.gltf (made by common/author_generic_head.py; our own drawing, with the
// published roles of CANDIDE's vertices). common/head_table_tool.cpp turns it into
// common/generic_head_table.cpp. The tables are integers and part of the format: SPEC.md gives their hash.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string_view>

#include "common/wire_frame.h"

namespace fbs {

inline constexpr int kVertexCount = 105;
/// Vertices of the outline, and of the ring round it.
inline constexpr int kRingCount = 24;

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

/// The tables, valid for the program's lifetime. No allocation.
struct GenericHead : WireFrame {
  std::array<ExpressionPart, kExpressionPartCount> expression;  ///< the same for every head
};

/// WireFrame::atlas. Made by common/author_head_atlas.py.
extern const std::array<glm::ivec2, kVertexCount + kRingCount> kHeadAtlas;

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

/// A feature of the generic head; closed, first_control and control_count are the same for all wire-frames.
[[nodiscard]] inline const Feature& feature(FeatureId id) {
  return generic_head().features[static_cast<std::size_t>(id)];
}

/// Control points that move a vertex of the generic head.
[[nodiscard]] inline std::span<const SkinningWeight> skinning_of(std::size_t vertex) {
  return generic_head().skinning_of(vertex);
}

/// The vertex of a landmark on the generic head.
/// @param ibug  0..67
[[nodiscard]] inline std::size_t vertex_of_landmark(std::size_t ibug) {
  return generic_head().landmark_vertex[ibug];
}

}  // namespace fbs
