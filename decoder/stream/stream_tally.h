// What a stream is made of: bytes and bits by what they are for.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "bitstream/motion/motion_bit_counter.h"
#include "bitstream/packet.h"
#include "bitstream/scene/scene_reader.h"

namespace fbs {

/// Bytes of a stream by purpose; the parts sum to `total`.
struct ByteCount {
  std::uint64_t total = 0;
  std::uint64_t startup = 0;   ///< prefix that must have arrived before the first picture can be shown
  std::uint64_t geometry = 0;  ///< wire-frame, geometry and surround packets
  std::uint64_t patterns = 0;
  std::uint64_t motion = 0;  ///< motion, blend and unit packets
  std::uint64_t blend = 0;   ///< of `motion`, blend packets and the blends of units
  std::uint64_t sound = 0;   ///< sound packets and their setups
  std::uint64_t other = 0;   ///< signature, setup, return, end, head part, unknown packets and skipped bytes
};

/// A pattern as received.
struct PatternRecord {
  int slot = 0;               ///< index into Scene::patterns, until another pattern comes for the slot
  std::uint64_t picture = 0;  ///< number in the stream of the picture it shows
  std::uint64_t bytes = 0;    ///< its share of the packet, in proportion to the frames
  bool reduced = false;       ///< coded at reduced size
};

class StreamTally {
 public:
  StreamTally();

  /// Counts the bits of motion from the next scene on, which takes as long again as to read it.
  void count_motion_bits() { counts_motion_bits_ = true; }
  /// Keeps a record of every pattern from now on.
  void record_patterns() { records_patterns_ = true; }

  void count(const Packet& packet);
  /// All that the first picture needs has come.
  void note_startup();
  /// @param reduced  of each pattern, whether it is coded at reduced size
  void add(const Packet& packet, const SceneReader& reader, std::span<const ScenePattern> patterns,
           const std::vector<bool>& reduced);
  void add(const MotionGroup& group, const SceneReader& reader);

  [[nodiscard]] const ByteCount& bytes() const { return bytes_; }
  /// Zero unless count_motion_bits() was called.
  [[nodiscard]] const PartBitsX256& motion_bits() const { return motion_bits_; }
  /// In order of arrival; empty unless record_patterns() was called.
  [[nodiscard]] const std::vector<PatternRecord>& patterns() const { return patterns_; }

 private:
  bool counts_motion_bits_ = false, records_patterns_ = false;
  ByteCount bytes_;
  std::map<std::uint64_t, MotionBitCounter> bit_counters_;  // by SceneReader::scene()
  PartBitsX256 motion_bits_{};
  std::vector<PatternRecord> patterns_;
};

}  // namespace fbs
