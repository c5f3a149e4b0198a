// The packets of one scene in stream order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/packet.h"
#include "encoder/scene/head_trickle.h"
#include "encoder/settings.h"

namespace fbs {

/// Payloads that come before all motion. Empty ones are not written.
struct SceneHead {
  std::vector<std::uint8_t> setup, geometry, surround, pattern;
};

/// Holds motion back until the scene has started: its head is learned from the first seconds.
class ScenePackets {
 public:
  /// @param live  whether heads of scenes are sent again
  explicit ScenePackets(const LiveSettings& live = {});

  void add_motion(std::span<const std::uint8_t> payload);

  /// Writes the head, then the motion held back.
  void start(const SceneHead& head);
  /// Writes a packet; the scene has started.
  void add(PacketType type, std::span<const std::uint8_t> payload);
  [[nodiscard]] bool started() const { return started_; }
  /// Writes the parts of the head that are due for viewers who join. All that has been added is released.
  void end_group();
  /// Begins another scene, and holds motion back until it has started. None may be held back now.
  void begin_again();

  /// Bytes written since the last call of count_from_here(), taken or not.
  [[nodiscard]] std::size_t counted() const { return written_ + ready_.size() - counted_from_; }
  void count_from_here() { counted_from_ = written_ + ready_.size(); }

  /// Whole packets that are ready; forgets them.
  [[nodiscard]] std::vector<std::uint8_t> take();

 private:
  void show_trickle();

  PacketWriter writer_;
  std::vector<std::vector<std::uint8_t>> held_back_;  // payloads of motion packets
  std::vector<std::uint8_t> ready_;
  std::size_t written_ = 0;  ///< bytes that have been taken
  std::size_t counted_from_ = 0;
  bool started_ = false;
  std::optional<HeadTrickle> trickle_;
  std::size_t shown_ = 0;  ///< bytes of ready_ that it has seen
};

}  // namespace fbs
