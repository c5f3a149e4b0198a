#include "decoder/export/gltf_buffer.h"

#include <algorithm>

namespace fbs {
namespace {

constexpr std::size_t kAlignment = 4;  // of all accessors: no component is longer

template <class T>
std::span<const std::uint8_t> bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size_bytes()};
}

}  // namespace

GltfBuffer::GltfBuffer(tinygltf::Model& model) : model_(model) {
  model_.buffers.emplace_back();
}

int GltfBuffer::add_view(std::span<const std::uint8_t> bytes, int target) {
  auto& data = model_.buffers.front().data;
  data.resize((data.size() + kAlignment - 1) / kAlignment * kAlignment);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = bytes.size();
  view.target = target;
  data.insert(data.end(), bytes.begin(), bytes.end());
  model_.bufferViews.push_back(view);
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

int GltfBuffer::add_accessor(int view, std::size_t count, int component_type, int type) {
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.count = count;
  accessor.componentType = component_type;
  accessor.type = type;
  model_.accessors.push_back(accessor);
  return static_cast<int>(model_.accessors.size()) - 1;
}

int GltfBuffer::add_absent(std::size_t count, int component_type, int type) {
  return add_accessor(-1, count, component_type, type);
}

void GltfBuffer::set_bounds(int accessor, std::span<const glm::vec3> values) {
  tinygltf::Accessor& a = model_.accessors[static_cast<std::size_t>(accessor)];
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(values.begin(), values.end(),
                            [axis](const glm::vec3& p, const glm::vec3& q) { return p[axis] < q[axis]; });
    a.minValues.push_back((*low)[axis]);
    a.maxValues.push_back((*high)[axis]);
  }
}

int GltfBuffer::add_vectors(std::span<const glm::vec3> values, bool bounds) {
  const int accessor = add_accessor(add_view(bytes_of(values), TINYGLTF_TARGET_ARRAY_BUFFER), values.size(),
                                    TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
  if (bounds) set_bounds(accessor, values);
  return accessor;
}

int GltfBuffer::add_vectors(std::span<const glm::vec2> values) {
  return add_accessor(add_view(bytes_of(values), TINYGLTF_TARGET_ARRAY_BUFFER), values.size(),
                      TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC2);
}

int GltfBuffer::add_indices(std::span<const std::uint16_t> corners) {
  return add_accessor(add_view(bytes_of(corners), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER), corners.size(),
                      TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR);
}

int GltfBuffer::add_displacements(std::span<const glm::vec3> values) {
  const auto moves = [](const glm::vec3& v) { return v != glm::vec3(0); };
  const auto moved = static_cast<std::size_t>(std::count_if(values.begin(), values.end(), moves));
  const std::size_t index_size = values.size() > 256 ? 2 : 1;
  if (moved * (sizeof(glm::vec3) + index_size) >= values.size() * sizeof(glm::vec3))
    return add_vectors(values, true);
  const int accessor = add_accessor(-1, values.size(), TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3);
  set_bounds(accessor, values);
  if (moved == 0) return accessor;
  auto& sparse = model_.accessors.back().sparse;
  sparse.isSparse = true;
  sparse.count = static_cast<int>(moved);
  sparse_indices_.resize((sparse_indices_.size() + index_size - 1) / index_size * index_size);
  sparse.indices.byteOffset = static_cast<int>(sparse_indices_.size());
  sparse.indices.componentType =
      index_size == 1 ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE : TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
  sparse.values.byteOffset = static_cast<int>(sparse_values_.size() * sizeof(glm::vec3));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!moves(values[i])) continue;
    for (std::size_t byte = 0; byte < index_size; ++byte)  // little-endian
      sparse_indices_.push_back(static_cast<std::uint8_t>(i >> (8 * byte)));
    sparse_values_.push_back(values[i]);
  }
  sparse_.push_back(accessor);
  return accessor;
}

void GltfBuffer::finish_displacements() {
  if (sparse_.empty()) return;
  const int indices = add_view(sparse_indices_),
            values = add_view(bytes_of(std::span<const glm::vec3>(sparse_values_)));
  for (const int accessor : sparse_) {
    auto& sparse = model_.accessors[static_cast<std::size_t>(accessor)].sparse;
    sparse.indices.bufferView = indices;
    sparse.values.bufferView = values;
  }
}

int GltfBuffer::add_animated(std::span<const float> values, int type, bool bounds) {
  const int accessor = add_accessor(add_view(bytes_of(values)),
                                    values.size() / static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                                                        static_cast<std::uint32_t>(type))),
                                    TINYGLTF_COMPONENT_TYPE_FLOAT, type);
  if (bounds) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    model_.accessors.back().minValues = {*low};
    model_.accessors.back().maxValues = {*high};
  }
  return accessor;
}

}  // namespace fbs
