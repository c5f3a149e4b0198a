// What the viewer adds to the motion of a stream: the head turned, the face moved. "Motions and deformations
// coming through keyboard", paper, Fig. 4.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bitstream/syntax.h"
#include "common/state.h"

namespace fbs {

/// Its values are offsets; 0 changes nothing.
enum class EditPart : std::uint8_t {
  kYaw,    ///< 2^-16 turn
  kPitch,  ///< 2^-16 turn
  kRoll,   ///< 2^-16 turn
  kBrows,  ///< head units; positive: raised
  kMouth,  ///< head units between the inner lips; positive: opened
  kSmile,  ///< head units at the corners; positive: out and up
  kLids,   ///< of kSkinningOne, the share of the opening that is shut; negative: opened wider
};
inline constexpr std::size_t kEditPartCount = 7;

/// The offsets, and how they are laid upon a state. Limits were set by eye on four clips: at any of them the
/// mouth is whole, the lids meet, and the outline of the head is not torn from the hair.
class StateEdit {
 public:
  struct Limits {
    std::int32_t low, high, step;  ///< step: of one press of a key
  };
  [[nodiscard]] static const Limits& limits(EditPart part);

  /// Adds so many steps, within the limits.
  void step(EditPart part, int steps) { add(part, steps * limits(part).step); }
  /// The same in units of the part.
  void add(EditPart part, std::int32_t offset);
  void reset() { values_ = {}; }

  [[nodiscard]] std::int32_t value(EditPart part) const { return values_[static_cast<std::size_t>(part)]; }
  [[nodiscard]] bool any() const { return values_ != Values{}; }

  /// The state to be drawn. Every value is within the limits of common/state.h. Lips open as far as the limit
  /// of kMouth and no farther together with what the state says, and lids never cross. Regions of the head
  /// that the state shows without motion are warped: they would not follow otherwise.
  /// @param head  adapted head of the scene
  [[nodiscard]] State applied(const State& state, const Geometry& head) const;

 private:
  using Values = std::array<std::int32_t, kEditPartCount>;
  Values values_{};
};

/// Warps those regions of the head that the state shows without motion: they would not follow a change of
/// pose or control points.
void set_in_motion(State& state);

}  // namespace fbs
