// Optimises patterns for their use: a coded pattern need not be a picture of the video. Blends and warps are
// linear in the patterns, so the patterns that minimise the squared error of all pictures drawn from them
// follow from linear least squares, solved by conjugate gradients (Hestenes & Stiefel, 1952).
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "decoder/scene/scene.h"
#include "encoder/blend/source_samples.h"

namespace fbs {

struct SolverSettings {
  int iterations = 4;
  double pull = 0.2;  ///< towards the source picture, relative to a sample's mean weight
};

/// Planes of one size that are drawn from the same positions, interleaved so as to be drawn at once.
struct SolvedPlanes {
  int width = 0, height = 0;
  std::vector<glm::vec4> samples;
  /// @param planes  1..4 of one size
  explicit SolvedPlanes(std::span<const ReducedPlane> planes);
  [[nodiscard]] ReducedPlane plane(int lane) const;
  [[nodiscard]] const glm::vec4* row(int y) const {
    return samples.data() + static_cast<std::ptrdiff_t>(y) * width;
  }
  [[nodiscard]] glm::vec4* row(int y) { return samples.data() + static_cast<std::ptrdiff_t>(y) * width; }
};

/// Planes of each pattern.
using PatternPlanes = std::vector<SolvedPlanes>;

/// The least squares problems of those planes of a scene's patterns that have the same reduced size.
class PatternSolver {
 public:
  /// @param scene      its patterns give the seen states; must outlive the object, with everything it refers
  ///                   to
  /// @param reduction  log2, relative to the picture
  /// @param planes     the planes to solve for, 0..2: light changes luma only, the mouth interior has its own
  ///                   colour in each
  PatternSolver(const BlendScene& scene, int reduction, std::vector<std::size_t> planes);

  /// Adds a picture drawn from the patterns.
  /// @param state      as drawn, blend modes included
  /// @param available  indices of the usable patterns
  /// @param size       of the picture's luma
  void add_picture(const State& state, std::span<const std::size_t> available, glm::ivec2 size);

  /// Memory used by the pictures.
  [[nodiscard]] std::size_t bytes() const;

  /// @param targets  the planes of each picture added
  /// @param sources  the planes of each pattern's own picture: start and anchor of the solution
  /// @param count    how many patterns, the last ones, to solve for
  [[nodiscard]] PatternPlanes solve(std::span<const SolvedPlanes> targets, PatternPlanes sources,
                                    std::size_t count, const SolverSettings& settings) const;

 private:
  /// Samples of a run that come from one pattern.
  struct Tap {
    SourceRun source;
    RunValue weight;
    SurfaceRun run;
    std::uint32_t pattern;
  };
  using Taps = std::vector<Tap>;

  /// A^T (targets - drawn planes): half the descent gradient of the squared error.
  [[nodiscard]] PatternPlanes gradient(std::span<const SolvedPlanes> targets,
                                       const PatternPlanes& planes) const;
  /// Mean total weight of a plane's samples over all pictures.
  [[nodiscard]] double mean_weight(const PatternPlanes& planes) const;
  /// The textures' share in the first sample of a run, and its increment per sample.
  [[nodiscard]] std::pair<glm::vec4, glm::vec4> factor(const Tap& tap) const;
  /// Draws samples without the terms that do not depend on the patterns: out += A planes
  void draw(const Taps& taps, const PatternPlanes& planes, SolvedPlanes& out) const;
  /// planes += A^T picture
  void draw_transposed(const Taps& taps, const SolvedPlanes& picture, PatternPlanes& planes) const;
  /// out += light and interior.
  void draw_constant(const Taps& taps, SolvedPlanes& out) const;

  BlendScene scene_;
  int reduction_;
  std::vector<std::size_t> planes_;    ///< plane of each lane in use
  glm::vec4 is_used_{0}, is_luma_{0};  ///< 1 for such lanes
  std::vector<Taps> pictures_;
};

}  // namespace fbs
