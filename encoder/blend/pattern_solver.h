// Optimises patterns for their use: a coded pattern need not be a picture of the video. Blends and warps are
// linear in the patterns, so the patterns that minimise the squared error of all pictures drawn from them
// follow from linear least squares, solved by conjugate gradients (Hestenes & Stiefel, 1952).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

#include "common/result.h"
#include "common/workers.h"
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
  SolvedPlanes() = default;
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

  /// Makes room for pictures that are drawn from the patterns.
  void resize(std::size_t pictures) { pictures_.resize(pictures); }
  /// Sets one of them. Several threads may set different ones at once.
  /// @param state      as drawn, blend modes included
  /// @param available  indices of the usable patterns
  /// @param size       of the picture's luma
  void set_picture(std::size_t number, const State& state, std::span<const std::size_t> available,
                   glm::ivec2 size);

  /// Whether a picture is drawn from a pattern.
  [[nodiscard]] bool uses(std::size_t pattern) const;
  /// Memory used by the pictures.
  [[nodiscard]] std::size_t bytes() const;

  /// The planes of a picture. Called once for each, by any worker.
  using Target = std::function<Result<SolvedPlanes>(std::size_t number)>;
  /// @param sources  the planes of each pattern's own picture: start and anchor of the solution; empty for
  ///                 those that neither are free nor used
  /// @param free     patterns to solve for; the others stay
  /// @return the solution less the sources, of those patterns; the same for any number of workers
  [[nodiscard]] Result<PatternPlanes> solve(const Target& target, PatternPlanes sources,
                                            std::span<const std::size_t> free, const SolverSettings& settings,
                                            Workers& workers) const;

 private:
  /// A run in few bits: there are a million.
  struct Run {
    std::uint16_t row, first, count;
  };
  /// A triangle's samples as far as they come from one pattern.
  struct Piece {
    std::uint32_t first_run, end_run;  ///< the triangle's
    TriangleValue weight;
    bool head, moved, lit;  ///< moved, lit: the next of FromPattern::places, ::lit is its own
  };
  /// What a picture draws from one pattern.
  struct FromPattern {
    std::size_t pattern;
    std::vector<Piece> pieces{};
    std::vector<TexturePlace> places{};
    std::vector<TriangleLight> lit{};
  };
  /// All that draw a picture.
  struct Drawn {
    std::vector<Run> runs;
    std::vector<FromPattern> patterns;

    /// Null where nothing is drawn from the pattern.
    [[nodiscard]] const FromPattern* from(std::size_t pattern) const;
  };
  /// The planes of each pattern; null: black.
  using Shown = std::vector<const SolvedPlanes*>;
  /// Draws a picture into the memory it is given.
  using Draw = std::function<Result<void>(std::size_t number, SolvedPlanes& out)>;

  /// How a run draws from a pattern.
  struct PieceRun {
    Run run;
    TexturePath path;
    glm::vec4 texture;  ///< share of the texture in each plane
    RunValue weight;
  };
  /// out += A^T pictures
  /// @param out  of the free patterns
  Result<void> add_transposed(const Draw& draw, std::span<const std::size_t> free, PatternPlanes& out,
                              Workers& workers) const;
  /// Draws samples without the terms that do not depend on the patterns: out += A planes
  void draw(const Drawn& picture, const Shown& planes, SolvedPlanes& out) const;
  /// plane += A^T picture, for one pattern
  void draw_transposed(const Drawn& picture, std::size_t pattern, const SolvedPlanes& samples,
                       SolvedPlanes& plane) const;
  /// Calls use(PieceRun, whether the texture is moved) for the runs drawn from a pattern.
  template <class Use>
  void for_each_run(const std::vector<Run>& runs, const FromPattern& from, Use&& use) const;
  /// out += light and interior.
  void draw_constant(const Drawn& picture, SolvedPlanes& out) const;
  void add_constant(const TriangleLight& light, Run run, const TriangleValue& weight,
                    SolvedPlanes& out) const;
  /// Total weight of all samples drawn.
  [[nodiscard]] double total_weight() const;

  BlendScene scene_;
  int reduction_;
  float inset_;                        ///< of the surround
  std::vector<std::size_t> planes_;    ///< plane of each lane in use
  glm::vec4 is_used_{0}, is_luma_{0};  ///< 1 for such lanes
  std::vector<Drawn> pictures_;
};

}  // namespace fbs
