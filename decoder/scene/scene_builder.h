// Builds the scene that pictures are drawn from, as its packets come.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bitstream/scene/scene_reader.h"
#include "common/result.h"
#include "decoder/pattern/pattern_decoder.h"
#include "decoder/scene/scene.h"

namespace fbs {

/// Geometry and surround wait for the first pattern, in whose state they are at rest.
class SceneBuilder {
 public:
  void begin(const Setup& setup, PatternDecoder patterns);

  void set_geometry(const Geometry& geometry) { geometry_ = geometry; }
  /// Takes effect with the first pattern, or with apply_surround().
  /// @return whether it is another one
  bool set_surround(const SurroundMap& surround) {
    const bool changes = !(surround == surround_);
    surround_ = surround;
    return changes;
  }
  /// Puts geometry and surround into the scene, and into its patterns.
  void apply_surround();

  struct MadePattern {
    Pattern pattern;
    bool reduced;  ///< coded at reduced size
  };
  /// Decodes the next pattern, which is yet to be put into the scene.
  /// @param keeps  it may come again: its picture is kept until a call without it, and not decoded twice
  /// @return errors of PatternDecoder
  [[nodiscard]] Result<MadePattern> make(const ScenePattern& pattern, bool keeps = false);

  /// Patterns whose pictures are kept in case they come again.
  [[nodiscard]] std::size_t kept() const { return decoded_.size(); }

  /// Puts a pattern into the scene.
  void store(Pattern pattern) { change().patterns.store(std::move(pattern)); }

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  /// The scene as it is now: what comes later does not change it.
  [[nodiscard]] std::shared_ptr<const Scene> shared() {
    shared_ = true;
    return scene_;
  }

 private:
  struct Decoded {
    std::int32_t picture, slot;  ///< of the pattern
    DecodedFrame frame;
  };
  [[nodiscard]] Result<DecodedFrame> decode(const PatternSyntax& pattern, bool keeps);
  [[nodiscard]] Result<DecodedFrame> decode_next(const PatternSyntax& pattern);

  /// To be changed, in a copy where it is shared.
  [[nodiscard]] Scene& change();

  std::shared_ptr<Scene> scene_ = std::make_shared<Scene>();
  bool shared_ = false;
  std::optional<Geometry> geometry_;
  SurroundMap surround_ = still_surround();
  State rest_;                              ///< in which the first pattern was seen
  std::vector<std::uint8_t> first_;         ///< AV1 frame of the first pattern
  std::optional<PatternDecoder> patterns_;  ///< of the chain; nothing: as after the first
  std::optional<PatternDecoder>
      alone_;                     ///< of patterns that are alone, once the chain has others than the first
  bool chained_ = false;          ///< it has
  std::vector<Decoded> decoded_;  ///< that may come again
};

}  // namespace fbs
