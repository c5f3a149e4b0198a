// The picture that was announced last, which can be drawn again although packets behind it change its scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"
#include "decoder/draw/renderer.h"
#include "decoder/scene/scene.h"

namespace fbs {

/// Holds the state of a picture and, where the scene that it is drawn from goes on to change, what shows it.
/// `scene` in all calls is the one that packets build.
class HeldPicture {
 public:
  /// The next picture is announced: patterns that have come for it go into its scene.
  void show(const State& state, const StreamPosition& position, std::uint32_t duration, Scene& scene);
  /// The same picture is announced once more, in the place of one that is missing.
  void hold(const StreamPosition& position, std::uint32_t duration);
  /// Another scene begins: keeps the old one as long as the picture may be drawn.
  void end_scene(Scene& scene);

  /// Puts a pattern into the scene, or has it wait as long as the picture may be drawn again.
  [[nodiscard]] Result<void> add(Pattern pattern, Scene& scene, Renderer& renderer);
  /// Ahead of another change of the scene: keeps the picture as it is drawn now. No pattern waits afterwards.
  [[nodiscard]] Result<void> keep(Scene& scene, Renderer& renderer);

  [[nodiscard]] std::uint64_t announced() const { return announced_; }  ///< pictures, held ones too
  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const StreamPosition& position() const { return position_; }
  [[nodiscard]] std::uint32_t duration() const { return duration_; }  ///< 1/90000 s
  [[nodiscard]] bool is_held() const { return held_; }
  /// Whether its scene is gone: any state shows it as it is.
  [[nodiscard]] bool is_kept() const { return kept_.has_value(); }
  /// Its scene.
  [[nodiscard]] const Scene& scene(const Scene& now) const { return past_ ? *past_ : now; }
  /// What draws it with its state.
  [[nodiscard]] const Scene& drawn_from(const Scene& now) const { return kept_ ? *kept_ : scene(now); }

 private:
  static constexpr std::size_t kMaxArrivals = 4;

  Result<void> draw(const Scene& scene, Renderer& renderer);
  void store_arrivals(Scene& scene);

  std::uint64_t announced_ = 0;
  State state_;
  StreamPosition position_;
  std::uint32_t duration_ = 0;
  bool held_ = false;
  std::optional<Scene> past_;  ///< its scene, if another one has begun
  std::optional<Scene> kept_;  ///< the picture itself, if its sources have changed
  /// Come into the scene with the next picture; a picture is only kept when there are too many.
  std::vector<Pattern> arrivals_;
};

}  // namespace fbs
