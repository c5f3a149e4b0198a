// Packets of a link that loses some and brings others in another order.
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

/// Puts packets in order. One that is missing is waited for until a number more than kReorder above it has
/// come, or skip() is called. After that the packets behind it are kept, and what the reader knew before:
/// when it comes after all, they are read again from there, so that what follows is as if nothing had been
/// late. SPEC 6.4.
///
/// Reading begins with packet 0, with a setup packet that is number 1, or with one above kReorder, where the
/// stream is joined. Any other first packet waits for those below it as for missing ones.
class LatePackets {
 public:
  /// How many numbers behind its place a packet may come without being given up.
  static constexpr std::uint64_t kReorder = 8;

  /// @param number  of the packet on the link: one more for each that was sent; below 2^64 - 1 (assert)
  void feed(std::uint64_t number, std::span<const std::uint8_t> bytes);

  /// No more will come: the stream ends behind what waits.
  void close() { closed_ = true; }
  [[nodiscard]] bool is_closed() const { return closed_; }
  /// Whether one has been fed.
  [[nodiscard]] bool has_begun() const { return begun_ || !kept_.empty() || !arrived_.empty(); }

  /// The packet to be read next.
  /// @param reader  has read those before; goes back if one comes late, and is told of those that are missing
  /// @return valid until the next call; nothing if none has come, or one that is missing is waited for
  [[nodiscard]] std::optional<std::span<const std::uint8_t>> next(SceneReader& reader);
  /// Whether packets before the one that next() returned last are missing.
  [[nodiscard]] bool is_behind_gap() const { return behind_gap_; }

  /// The next call of next() does not wait, but goes on with the lowest number behind what is missing.
  /// @return whether a packet waits
  bool skip();

  /// Whether the packet that next() returned last may be read again.
  [[nodiscard]] bool is_kept() const { return before_ && given_up_ < next_; }
  /// It begins a scene, or returns to one: those before it are of no use any longer.
  void begin_scene();
  /// The first picture is shown: packets below those that have been read are of no use any longer.
  void begin_pictures();

  /// Numbers that are missing and still of use, by rising number.
  /// @param most  how many at most
  [[nodiscard]] std::vector<std::uint64_t> missing(std::size_t most) const;
  /// Those below `number` that are missing will not come.
  void give_up(std::uint64_t number) { given_up_ = std::max(given_up_, number); }
  /// None that next() has gone past will come.
  void give_up() { give_up(next_); }

 private:
  struct Received {
    std::uint64_t number;
    std::vector<std::uint8_t> bytes;

    /// Whether reading may begin with it: a setup packet, and not soon after the beginning of the stream,
    /// which then is late.
    [[nodiscard]] bool begins() const;
  };

  /// Drops what has been read if nothing before it could still be read.
  void drop_complete();
  /// Takes in a packet. One that comes twice, or too late, is left out.
  void place(Received packet, SceneReader& reader);
  /// Whether one can be read, and nothing before it is waited for.
  [[nodiscard]] bool may_read() const;
  /// What comes before the first setup packet is not read, unless the stream begins with it.
  void find_start();
  /// Packets from next_ up to `number` are missing.
  void pass_gap(std::uint64_t number, SceneReader& reader);
  /// The lowest number that might be missing and of use.
  [[nodiscard]] std::uint64_t lowest_missing() const;

  std::deque<Received> arrived_;       ///< not placed yet
  std::vector<Received> kept_;         ///< by number
  std::size_t position_ = 0;           ///< in kept_, of the next to be read
  bool begun_ = false;                 ///< one has been read
  std::uint64_t next_ = 0;             ///< behind the number that was read last
  std::uint64_t end_ = 0;              ///< behind the highest number placed
  std::optional<SceneReader> before_;  ///< as it was before `first_`; nothing while none is missing
  std::uint64_t first_ = 0;            ///< the number behind `before_`
  bool at_start_ = false;              ///< `before_` has read nothing: the start may come late
  std::uint64_t given_up_ = 0;         ///< numbers below are neither waited for nor of use
  std::uint64_t skipped_ = 0;          ///< numbers below are not waited for, but of use
  bool skips_ = false;                 ///< skip() has been called
  bool behind_gap_ = false;
  bool closed_ = false;
};

}  // namespace fbs
