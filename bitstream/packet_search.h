// Finds packets in damaged streams. SPEC 3.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace fbs {

/// A search believes lengths up to this many bytes only: it bounds what the search remembers.
inline constexpr std::size_t kMaxSearchedPayload = std::size_t{1} << 20;

/// Reads bytes once, one after the other, and keeps every place where a packet of a known type may begin
/// until that packet's end is reached and its check can be tested. Takes the first that ends with the right
/// check. Time is linear in the bytes times the logarithm of kMaxSearchedPayload, whatever they are.
class PacketSearch {
 public:
  /// Begins at `position` of the stream.
  explicit PacketSearch(std::size_t position) : position_(position) {}

  /// Goes on over `stream`, which has the bytes of the calls before at the same places, maybe more behind.
  /// @param closed  no more bytes will come
  /// @return where a packet begins, once one was found; nothing: call again with more bytes
  [[nodiscard]] std::optional<std::size_t> find(std::span<const std::uint8_t> stream, bool closed);

  /// No packet can be found that begins before this place.
  [[nodiscard]] std::size_t first_open() const;

  /// The stream has lost its first `count` bytes, count <= first_open(): places are `count` less from now on.
  void drop_front(std::size_t count);

 private:
  struct Candidate {
    std::size_t begin;
    std::size_t end;           // behind the payload, where the check begins
    std::uint16_t sum_before;  // running sum of the bytes before `begin`
  };
  static bool later(const Candidate& a, const Candidate& b) { return a.end > b.end; }
  void add_candidate(std::span<const std::uint8_t> stream);

  std::vector<Candidate> candidates_;  // a heap: the smallest end in front
  std::size_t position_;               // bytes before it are in the running sum
  std::uint16_t sum_ = 0;              // CRC with initial value zero over the bytes before position_
};

}  // namespace fbs
