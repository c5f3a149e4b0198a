// The binary part of a glTF model: bytes, views of them, and the accessors that describe them.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "decoder/export/tinygltf.h"

namespace fbs {

/// Appends to buffer 0 of a model. All functions return the index of the accessor or view added.
class GltfBuffer {
 public:
  /// @param model  must outlive the object; its first buffer is created
  explicit GltfBuffer(tinygltf::Model& model);

  /// @param target  TINYGLTF_TARGET_...; 0: none, as for images and animations
  int add_view(std::span<const std::uint8_t> bytes, int target = 0);

  /// Vertex attributes. With bounds where glTF wants them (POSITION).
  int add_vectors(std::span<const glm::vec3> values, bool bounds);
  int add_vectors(std::span<const glm::vec2> values);
  /// Corners of triangles.
  int add_indices(std::span<const std::uint16_t> corners);
  /// The same without bytes, which an extension holds.
  int add_absent(std::size_t count, int component_type, int type);

  /// Displacements of at most 65535 vertices, stored sparsely where that takes fewer bytes; if all are zero,
  /// without data.
  int add_displacements(std::span<const glm::vec3> values);
  /// Minimum and maximum of each coordinate.
  void set_bounds(int accessor, std::span<const glm::vec3> values);

  /// Adds the data that sparse displacements share. Call once, last.
  void finish_displacements();

  /// Times or values of an animation, concatenated.
  /// @param type  TINYGLTF_TYPE_...
  int add_animated(std::span<const float> values, int type, bool bounds);

 private:
  int add_accessor(int view, std::size_t count, int component_type, int type);

  tinygltf::Model& model_;
  std::vector<std::uint8_t> sparse_indices_;
  std::vector<glm::vec3> sparse_values_;
  std::vector<int> sparse_;  ///< accessors whose views are not known yet
};

}  // namespace fbs
