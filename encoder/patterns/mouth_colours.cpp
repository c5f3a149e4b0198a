#include "encoder/patterns/mouth_colours.h"

#include <algorithm>
#include <cmath>

#include "encoder/model/pose.h"

namespace fbs {
namespace {

constexpr double kOpen = 0.10;            // opening of the outer lips beyond rest, eye distances
constexpr std::int64_t kMinPictures = 3;  // fewer may be a tongue or a shadow
constexpr int kMidlineSteps = 24;         // along the midline

glm::dvec2 seen_at(std::span<const glm::ivec3> vertices, std::size_t landmark) {
  const glm::ivec3 p = vertices[vertex_of_landmark(landmark)];
  return glm::dvec2(p.x, p.y) / kStateUnitsPerPixel;
}

}  // namespace

void MouthColours::Sum::add(const Picture& picture, glm::dvec2 at) {
  const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
  if (x < 0 || y < 0 || x >= picture.width() || y >= picture.height()) return;
  u += picture.u.row(y / 2)[x / 2];
  v += picture.v.row(y / 2)[x / 2];
  ++count;
}

void MouthColours::Sum::set_chroma(YuvColour& colour) const {
  if (count < kMinPictures) return;
  colour.u = static_cast<std::uint8_t>((u + count / 2) / count);
  colour.v = static_cast<std::uint8_t>((v + count / 2) / count);
}

std::int32_t mouth_height(std::span<const glm::ivec3> vertices) {
  const glm::dvec2 d = kStateUnitsPerPixel * (seen_at(vertices, 57) - seen_at(vertices, 51));
  return static_cast<std::int32_t>(std::hypot(d.x, d.y));
}

void MouthColours::add(const Picture& picture, std::span<const glm::ivec3> vertices) {
  if (mouth_height(vertices) - rest_height_ < kOpen * eye_distance_px_ * kStateUnitsPerPixel) return;
  const glm::dvec2 top = seen_at(vertices, 51), bottom = seen_at(vertices, 57);
  glm::dvec2 darkest = top;
  int least = 256;
  for (int i = kMidlineSteps / 5; i <= kMidlineSteps - kMidlineSteps / 5; ++i) {
    const glm::dvec2 p = top + (bottom - top) * (static_cast<double>(i) / kMidlineSteps);
    const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
    if (x < 0 || y < 0 || x >= picture.width() || y >= picture.height()) return;
    if (picture.y.row(y)[x] < least) {
      least = picture.y.row(y)[x];
      darkest = p;
    }
  }
  lower_.add(picture, darkest);
  upper_.add(picture, 0.5 * (darkest + seen_at(vertices, 62)));
}

void MouthColours::set_chroma(MouthInterior& mouth) const {
  upper_.set_chroma(mouth.upper);
  lower_.set_chroma(mouth.lower);
}

}  // namespace fbs
