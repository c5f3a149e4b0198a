// The talker's head as a surface: distance function, ray hits, landmarks. Frame and unit as in talker_face.h.
//
// Skull and jaw are ellipsoids joined smoothly; brow ridge, sockets, nose, cheeks, lips and chin are soft
// bumps on them; ears and hair are added. Nothing here depends on the codec's head.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>

#include "tests/talker/talker_face.h"

namespace fbs::talker {

inline constexpr int kLandmarkTotal = 68;  ///< iBUG-68

/// An ellipsoid around the head with hair, mouth wide open.
inline constexpr glm::vec3 kBoundCentre{0, 0.09f, 0.0f};
inline constexpr glm::vec3 kBoundRadii{1.60f, 2.30f, 1.85f};

/// Roughly the distance from q to the head at rest, negative inside; its zero is the surface.
[[nodiscard]] float head_distance(glm::vec3 q);

/// The same without hair and ears.
[[nodiscard]] float skull_distance(glm::vec3 q);

/// Positive where hair grows, in eye distances from the hairline.
[[nodiscard]] float hair_depth(glm::vec3 q);

struct SurfacePoint {
  glm::vec3 position;  ///< on the moved face
  glm::vec3 rest;      ///< the same skin at rest
};

/// Result of tracing a ray.
struct Trace {
  std::optional<SurfacePoint> point;  ///< the first point of the head on the ray, if there is one
  float depth = 0;                    ///< its distance from the ray's origin
  float clearance = 0;                ///< of a ray that misses: roughly how far it passes, eye distances
};

/// Follows the ray origin + t * direction, t >= 0, to the moved head; direction has length 1.
/// @param near  depth at which a neighbouring ray hit the head; tracing starts slightly before it
[[nodiscard]] Trace trace(glm::vec3 origin, glm::vec3 direction, const Expression& e,
                          std::optional<float> near = std::nullopt);

/// Outward unit normal of the moved head at p.
[[nodiscard]] glm::vec3 normal(glm::vec3 p, const Expression& e);

/// Height (z) of the face at rest at (x, y) seen from the front.
[[nodiscard]] float front_z(float x, float y);

/// Centre and radius of an eyeball; side -1 for the right eye, +1 for the left.
[[nodiscard]] glm::vec3 eyeball_centre(int side);
inline constexpr float kEyeballRadius = 0.27f;

/// The 68 points on the moved head: points of its surface, brows on their middle line, lips and lids on the
/// edges that are painted. 0..16 lie on the border of the face as seen from the front, where a contour is.
[[nodiscard]] std::array<glm::vec3, kLandmarkTotal> landmarks(const Expression& e);

}  // namespace fbs::talker
