// The head in the scene's first picture, sampled at points fixed on the mesh.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "encoder/model/surface.h"
#include "encoder/track/head/levelled_frame.h"

namespace fbs {

struct TrackedPose {
  Pose pose;
  double confidence = 0;  ///< 0..1: HeadAppearance::correlation() at the pose
};

class HeadAppearance {
 public:
  /// @param neutral  vertices of the adapted head, head units
  /// @param first    the first picture, in which the head is seen in `pose`
  HeadAppearance(const HeadVertices& neutral, const Pose& pose, const WorkFrame& first);

  /// Eye distance in the first picture, which sets the scale of work frames.
  [[nodiscard]] double eye_distance_px() const { return eye_distance_px_; }
  /// The points, head units, with the expression of `vertices`.
  [[nodiscard]] std::vector<glm::dvec3> surface(const HeadVertices& vertices) const;
  /// The triangle of each point.
  [[nodiscard]] std::span<const SurfacePoint> points() const { return points_; }
  /// Levels of the points at a level of LevelledFrame, 8 bits; negative where not seen.
  [[nodiscard]] std::span<const float> seen(int level) const { return seen_[level]; }
  /// How reliably each point moves with the head, 0..1.
  [[nodiscard]] std::span<const float> weights() const { return weight_; }

  /// Weighted correlation of the points in `now` with the first picture, 0..1.
  /// @param points  surface() with the present expression
  [[nodiscard]] double correlation(const LevelledFrame& now, const Pose& pose,
                                   std::span<const glm::dvec3> points) const;

  /// How far the colours of the points in `now` are from those of the first picture in the present light:
  /// difference of both chroma planes together, 8 bits, weighted mean; 0 where too few points are seen.
  /// @param now  with colour, as the first picture's
  [[nodiscard]] double colour_difference(const WorkFrame& now, const Pose& pose,
                                         std::span<const glm::dvec3> points) const;

 private:
  /// Luma, and chroma less its grey.
  using Colour = std::array<double, 3>;
  [[nodiscard]] static std::optional<Colour> colour_at(const WorkFrame& frame, glm::dvec2 picture);

  double eye_distance_px_;
  std::vector<SurfacePoint> points_;
  std::vector<float> weight_;
  std::array<std::vector<float>, LevelledFrame::kLevels> seen_;
  std::vector<std::optional<Colour>> colour_;  ///< of the points in the first picture; empty: unknown
};

}  // namespace fbs
