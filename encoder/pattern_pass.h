// The second pass over a scene: with all pictures analysed and their motion planned, chooses, codes and places
// the patterns.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bitstream/motion/motion_encoder.h"
#include "decoder/scene.h"
#include "encoder/blend/pattern_solver.h"
#include "encoder/patterns/pattern_sequence.h"
#include "encoder/picture_spool.h"

namespace fbs {

struct PatternPassSettings {
  int patterns = 8;   ///< of the scene
  SequenceSettings coding;
  int rounds = 0;      ///< of making patterns for their use
  SolverSettings solver;
  double lambda = 0;   ///< squared luma levels that a bit is worth
};

/// A packet to be written.
using TypedPayload = std::pair<PacketType, std::vector<std::uint8_t>>;

class PatternPass {
 public:
  PatternPass(const VideoFormat& format, const PatternPassSettings& settings)
      : format_(format), settings_(settings) {}

  /// The next picture of the scene.
  Result<void> add(const Picture& picture) { return pictures_.add(picture); }
  /// The next group of them.
  /// @param states  of its pictures
  void add(std::vector<State> states, std::vector<std::uint8_t> payload);

  /// @param scene  geometry as it is sent; its patterns are replaced
  /// @param seen   of pattern 0
  /// @return all that follows setup, geometry and surround
  [[nodiscard]] Result<std::vector<TypedPayload>> finish(Scene& scene, const CodedState& seen);

 private:
  struct Group {
    std::vector<State> states;
    std::vector<std::uint8_t> payload;
  };

  [[nodiscard]] Result<std::vector<SequencePattern>> code_patterns(std::span<const Picture> pictures,
                                                                   std::span<const std::size_t> times);
  /// Pictures to be coded as the patterns of the scene, in its order.
  [[nodiscard]] Result<std::vector<Picture>> solve(const Scene& scene, std::span<const State> states,
                                                   std::span<const std::size_t> arrivals);
  /// Number of patterns, in coding order, that are sent before the pictures of each group.
  [[nodiscard]] std::vector<std::size_t> arrivals(std::span<const SequencePattern> patterns) const;
  [[nodiscard]] Result<std::vector<RegionModes>> choose(const Scene& scene, std::span<const State> states,
                                                        std::span<const std::size_t> arrivals);

  VideoFormat format_;
  PatternPassSettings settings_;
  PictureSpool pictures_;
  std::vector<Group> groups_;
};

}  // namespace fbs
