// The viewer's additions to the motion of a stream: a turned head, a moved face. "Motions and deformations
// coming through keyboard", paper, Fig. 4.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "bitstream/syntax.h"
#include "common/state.h"

namespace fbs {

/// Values are offsets; 0 changes nothing.
enum class EditPart : std::uint8_t {
  kYaw,    ///< 2^-16 turn
  kPitch,  ///< 2^-16 turn
  kRoll,   ///< 2^-16 turn
  kBrows,  ///< head units; positive: raised
  kMouth,  ///< head units between the inner lips; positive: opened
  kSmile,  ///< head units at the corners; positive: out and up
  kLids,   ///< share of the opening that is shut, in 1/kSkinningOne; negative: opened wider
};
inline constexpr std::size_t kEditPartCount = 7;

/// The offsets, applied on top of a state. Limits were set by eye on four clips: at any of them the mouth is
/// whole, the lids meet, and the outline of the head does not tear from the hair.
class StateEdit {
 public:
  struct Limits {
    std::int32_t low, high, step;  ///< step: for one press of a key
  };
  [[nodiscard]] static const Limits& limits(EditPart part);

  /// Adds this many steps, within the limits.
  void step(EditPart part, int steps) { add(part, steps * limits(part).step); }
  /// The same in units of the part.
  void add(EditPart part, std::int32_t offset);
  void reset() { values_ = {}; }
  [[nodiscard]] bool operator==(const StateEdit&) const = default;

  [[nodiscard]] std::int32_t value(EditPart part) const { return values_[static_cast<std::size_t>(part)]; }
  [[nodiscard]] bool any() const { return values_ != Values{}; }

  /// The state to be drawn, with every value within the limits of common/state.h. The lips open no farther
  /// than kMouth's limit, the state's own gap included, and lids never cross. Regions of the head that the
  /// state shows without motion are warped: otherwise they would not follow.
  /// @param head  adapted head of the scene
  [[nodiscard]] State applied(const State& state, const Geometry& head) const;

 private:
  using Values = std::array<std::int32_t, kEditPartCount>;
  Values values_{};
};

/// Warps the regions of the head that the state shows without motion: otherwise they would not follow a
/// change of pose or control points.
void set_in_motion(State& state);

}  // namespace fbs
