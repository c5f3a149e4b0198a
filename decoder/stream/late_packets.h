// Packets of a link that loses some and brings some late.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/scene/scene_reader.h"

namespace fbs {

/// Puts packets in order as far as that is still possible. While one is missing it keeps those behind it, and
/// what the reader knew before: when it comes after all, they are read again from there, so that what follows
/// is as if nothing had been late. SPEC 6.4.
class LatePackets {
 public:
  /// @param number  of the packet on the link: one more for each that was sent
  void feed(std::uint64_t number, std::span<const std::uint8_t> bytes);

  /// No more will come: the stream ends behind what waits.
  void close() { closed_ = true; }
  [[nodiscard]] bool is_closed() const { return closed_; }
  /// Whether one has been fed.
  [[nodiscard]] bool has_begun() const { return expected_ || !arrived_.empty(); }

  /// The packet to be read next.
  /// @param reader  has read those before; goes back if one comes late
  /// @return valid until the next call; nothing if none waits
  [[nodiscard]] std::optional<std::span<const std::uint8_t>> next(SceneReader& reader);

  /// Whether the packet that next() returned last may be read again.
  [[nodiscard]] bool is_kept() const { return before_ && given_up_ < *expected_; }
  /// It begins a scene, or returns to one: those before it are not waited for any longer.
  void begin_scene();

  /// Numbers that are missing and still of use, by rising number.
  /// @param most  how many at most
  [[nodiscard]] std::vector<std::uint64_t> missing(std::size_t most) const;
  /// Those below `number` that are missing will not come.
  void give_up(std::uint64_t number) { given_up_ = std::max(given_up_, number); }
  /// None that is missing now will come.
  void give_up() { give_up(expected_.value_or(0)); }

 private:
  struct Received {
    std::uint64_t number;
    std::vector<std::uint8_t> bytes;
  };

  /// Drops what has been read if nothing before it is waited for.
  void drop_complete(const SceneReader& reader);
  /// Takes in a packet that has come while one is missing. One that comes twice, or too late, is left out.
  void place(Received packet, SceneReader& reader);

  std::deque<Received> arrived_;           ///< not placed yet
  std::optional<std::uint64_t> expected_;  ///< behind the highest number placed
  std::optional<SceneReader> before_;      ///< as it was before `first_`; nothing while none is missing
  std::uint64_t first_ = 0;                ///< the number behind `before_`
  std::vector<Received> kept_;             ///< by number, from first_ on
  std::size_t position_ = 0;               ///< in kept_, of the next to be read
  std::uint64_t given_up_ = 0;             ///< numbers below are not waited for
  Received current_{};                     ///< read last, where none is missing
  bool closed_ = false;
};

}  // namespace fbs
