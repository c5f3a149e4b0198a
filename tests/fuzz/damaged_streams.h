// Damaged versions of a stream, numbered: the same number is always the same version.
#pragma once

#include <string>

#include "tests/fuzz/stream_mutator.h"

namespace fbs::fuzz {

/// Truncations; every packet left out, repeated, or swapped with the next, once with the original checks
/// and once with right ones; then mutations.
class DamagedStreams {
 public:
  /// @param stream, others  must outlive the object; mutations take packets from `others`, at least one
  ///                        stream
  /// @param cut_step        bytes from one truncation to the next; at least 1
  DamagedStreams(const Bytes& stream, const std::vector<Bytes>& others, std::size_t cut_step,
                 std::size_t mutations);

  [[nodiscard]] std::size_t count() const { return cuts() + kPacketDamages * packets() + mutations_; }

  /// @param number  0..count() - 1
  [[nodiscard]] Bytes operator[](std::size_t number) const;

  /// A description of the damage.
  [[nodiscard]] std::string what(std::size_t number) const;

 private:
  static constexpr std::size_t kPacketDamages = 6;
  [[nodiscard]] std::size_t cuts() const { return (stream_.size() + cut_step_ - 1) / cut_step_; }
  [[nodiscard]] std::size_t packets() const { return borders_.size() - 1; }
  [[nodiscard]] Bytes with_damaged_packet(std::size_t packet, std::size_t damage) const;

  const Bytes& stream_;
  const std::vector<Bytes>& others_;
  std::size_t cut_step_, mutations_;
  std::vector<std::size_t> borders_;  // of the packets
};

}  // namespace fbs::fuzz
