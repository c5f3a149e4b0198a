#include "common/generic_head.h"

namespace fbs {
namespace {

/// FNV-1a, 64 bits, over numbers as little-endian 32-bit two's complement.
class Fnv1a {
 public:
  void add(std::int64_t number) {
    const auto bits = static_cast<std::uint32_t>(number);
    for (int shift = 0; shift < 32; shift += 8) {
      hash_ = (hash_ ^ (bits >> shift & 0xFF)) * 0x100000001B3;
    }
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325;
};

}  // namespace

std::uint64_t generic_head_hash() {
  const GenericHead& head = generic_head();
  Fnv1a hash;
  hash.add(kVertexCount);
  for (const HeadVertex& vertex : head.vertices) {
    for (const int number : {vertex.position.x, vertex.position.y, vertex.position.z}) hash.add(number);
    for (const int number : {vertex.mirror, vertex.landmark, vertex.feature}) hash.add(number);
  }
  hash.add(static_cast<std::int64_t>(head.triangles.size()));
  for (const HeadTriangle& triangle : head.triangles) {
    for (const int corner : triangle) hash.add(corner);
  }
  hash.add(static_cast<std::int64_t>(head.outline.size()));
  for (const int vertex : head.outline) hash.add(vertex);
  hash.add(kFeatureCount);
  for (const Feature& feature : head.features) {
    hash.add(feature.closed ? 1 : 0);
    hash.add(feature.first_control);
    hash.add(feature.control_count);
    hash.add(static_cast<std::int64_t>(feature.vertices.size()));
    for (const FeatureVertex& point : feature.vertices) hash.add(point.vertex);
  }
  for (std::size_t v = 0; v < kVertexCount; ++v) {
    hash.add(head.skinning_begin[v + 1] - head.skinning_begin[v]);
    for (std::size_t i = head.skinning_begin[v]; i < head.skinning_begin[v + 1]; ++i) {
      hash.add(head.skinning[i].control);
      hash.add(head.skinning[i].weight);
    }
  }
  hash.add(kExpressionPartCount);
  for (const ExpressionPart& part : head.expression) {
    hash.add(part.first_control);
    hash.add(part.control_count);
    for (const std::int16_t weight : part.rows) hash.add(weight);
  }
  return hash.value();
}

}  // namespace fbs
