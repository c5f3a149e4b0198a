// Patterns made for their use: what is coded as a pattern need not be a picture of the video. Blends and
// warps are linear in the patterns, so those that minimise the squared error of all pictures drawn from them
// follow from linear least squares, solved by conjugate gradients (Hestenes & Stiefel, 1952).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decoder/scene.h"
#include "encoder/blend/source_samples.h"

namespace fbs {

struct SolverSettings {
  int iterations = 4;
  double pull = 0.2;  ///< towards the source picture, over the mean weight with which a sample is used
};

/// Planes of one size, of each pattern.
using PatternPlanes = std::vector<ReducedPlane>;

/// The least squares problem of a scene at one reduced size. Planes that are drawn alike share it.
class PatternSolver {
 public:
  /// @param scene  its patterns give the seen states; what it refers to must outlive the object
  PatternSolver(const BlendScene& scene, int reduction) : scene_(scene), reduction_(reduction) {}

  /// A picture that is drawn from the patterns.
  /// @param state      as drawn, blend modes included
  /// @param available  indices of patterns that can be used
  /// @param size       of the picture, luma
  void add_picture(const State& state, std::span<const std::size_t> available, glm::ivec2 size);

  /// Memory that the pictures take.
  [[nodiscard]] std::size_t bytes() const;

  /// @param targets  the plane of each picture added
  /// @param sources  the plane of each pattern's own picture: start and anchor of the solution
  /// @param count    of patterns, the last ones, that are solved for
  /// @param plane    of the three: light changes luma only, the mouth interior has its own colour in each
  [[nodiscard]] PatternPlanes solve(std::span<const ReducedPlane> targets, PatternPlanes sources,
                                    std::size_t count, std::size_t plane,
                                    const SolverSettings& settings) const;

 private:
  /// Samples of a run that come from one pattern.
  struct Tap {
    SourceRun source;
    RunValue weight;
    SurfaceRun run;
    std::uint32_t pattern;
  };
  using Taps = std::vector<Tap>;

  /// A^T (targets - what the planes draw): half the gradient of the squared error, downhill.
  [[nodiscard]] PatternPlanes gradient(std::span<const ReducedPlane> targets, const PatternPlanes& planes,
                                       std::size_t plane) const;
  /// With which a sample of the planes is used in all pictures together.
  [[nodiscard]] double mean_weight(const PatternPlanes& planes) const;
  /// Samples as drawn without what does not depend on the patterns. out += A planes
  static void draw(const Taps& taps, const PatternPlanes& planes, bool luma, ReducedPlane& out);
  /// planes += A^T picture
  static void draw_transposed(const Taps& taps, const ReducedPlane& picture, bool luma,
                              PatternPlanes& planes);
  /// out += what light and interior add.
  static void draw_constant(const Taps& taps, std::size_t plane, ReducedPlane& out);

  BlendScene scene_;
  int reduction_;
  std::vector<Taps> pictures_;
};

}  // namespace fbs
