// The head of a live scene, sent again little by little for viewers who join. SPEC 4.12.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/packet.h"
#include "bitstream/scene/scene_reader.h"
#include "encoder/segment/segment.h"

namespace fbs {

/// Follows the packets of a stream, and makes the parts of the present scene's head: many soon after its
/// beginning, unless that is the first of the stream, and some steadily.
class HeadTrickle {
 public:
  /// @param join  s: in which a viewer can join, if a tenth of the packets is lost; 0: nothing comes steadily
  explicit HeadTrickle(double join);

  /// The next packets of the stream, which it wrote itself (assert).
  void add(std::span<const std::uint8_t> packets);

  /// What is to follow them: parts and, from time to time, the last surround.
  [[nodiscard]] std::vector<TypedPayload> due();

 private:
  /// How many heads are to be sent by now.
  [[nodiscard]] double heads() const;
  /// @param whole  the packet
  void add(const Packet& packet, std::span<const std::uint8_t> whole);

  double join_;  ///< s
  PacketReader packets_;
  SceneReader reader_;
  // The scene's:
  std::vector<std::uint8_t> head_;      ///< packets up to the first pattern
  std::vector<std::uint8_t> surround_;  ///< payload of the last surround packet behind them
  bool complete_ = false;
  HeadPart next_;
  int sent_ = 0;  ///< parts
};

}  // namespace fbs
