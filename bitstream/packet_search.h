// Finds packets in damaged streams. SPEC 3.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace fbs {

/// Longer payloads are not searched for, which bounds the memory of a search.
inline constexpr std::size_t kMaxSearchedPayload = std::size_t{1} << 20;

/// Reads each byte once and keeps every place where a packet of a known type may begin until the end of that
/// packet, where its check can be tested. The first packet to end with the right check is found. Time is
/// O(n log kMaxSearchedPayload) for any n bytes.
class PacketSearch {
 public:
  /// @param position  first position where a packet may begin
  explicit PacketSearch(std::size_t position) : position_(position) {}

  /// Continues over `stream`, which begins with the bytes of the calls before.
  /// @param closed  no more bytes will come
  /// @return the position of the packet found; nothing: call again with more bytes
  [[nodiscard]] std::optional<std::size_t> find(std::span<const std::uint8_t> stream, bool closed);

  /// No packet that begins before this position can be found.
  [[nodiscard]] std::size_t first_open() const;

  /// The caller has dropped the first `count` bytes, count <= first_open(): positions are `count` less from
  /// now on.
  void drop_front(std::size_t count);

 private:
  struct Candidate {
    std::size_t begin;
    std::size_t end;           // of the payload, where the check begins
    std::uint16_t sum_before;  // running sum of the bytes before `begin`
  };
  static bool later(const Candidate& a, const Candidate& b) { return a.end > b.end; }
  void add_candidate(std::span<const std::uint8_t> stream);

  std::vector<Candidate> candidates_;  // a heap: the smallest end in front
  std::size_t position_;               // bytes before it are in the running sum
  std::uint16_t sum_ = 0;              // CRC with initial value zero over the bytes before position_
};

}  // namespace fbs
