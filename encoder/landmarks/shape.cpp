#include "encoder/landmarks/shape.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "common/ibug.h"

namespace fbs {
namespace {

std::complex<float> complex_of(glm::vec2 p) {
  return {p.x, p.y};
}

glm::vec2 mean(std::span<const glm::vec2> points) {
  return std::accumulate(points.begin(), points.end(), glm::vec2(0)) / static_cast<float>(points.size());
}

}  // namespace

float eye_distance(const Shape& shape) {
  const auto eyes = std::span(shape).subspan(ibug::kEyesFirst, 2 * ibug::kEyePoints);
  const glm::vec2 d = mean(eyes.last(ibug::kEyePoints)) - mean(eyes.first(ibug::kEyePoints));
  return std::hypot(d.x, d.y);
}

glm::vec2 mean_of(const Shape& shape) {
  return mean(shape);
}

int mirrored_landmark(int landmark) {
  const GenericHead& head = generic_head();
  const auto partner = static_cast<std::uint16_t>(head.vertices[vertex_of_landmark(landmark)].mirror);
  return static_cast<int>(
      std::distance(head.landmark_vertex.begin(), std::ranges::find(head.landmark_vertex, partner)));
}

Shape PlaneSimilarity::operator()(const Shape& shape) const {
  Shape out;
  std::ranges::transform(shape, out.begin(), [this](glm::vec2 p) { return (*this)(p); });
  return out;
}

PlaneSimilarity PlaneSimilarity::between(const Shape& from, const Shape& to) {
  const std::complex<float> from_mean = complex_of(mean(from)), to_mean = complex_of(mean(to));
  std::complex<float> product = 0;
  float size = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const std::complex<float> f = complex_of(from[k]) - from_mean;
    product += std::conj(f) * (complex_of(to[k]) - to_mean);
    size += std::norm(f);
  }
  const std::complex<float> turn = size > 0 ? product / size : 1;
  return {turn, to_mean - turn * from_mean};
}

}  // namespace fbs
