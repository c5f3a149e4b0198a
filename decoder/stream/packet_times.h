// When the packets of a stream count, found without drawing anything.
#pragma once

#include <cstdint>
#include <optional>

#include "bitstream/packet.h"
#include "bitstream/scene/scene_reader.h"
#include "common/result.h"
#include "decoder/stream/stream_clock.h"

namespace fbs {

/// What a packet says, and when.
struct TimedPacket {
  SceneSyntax syntax;
  /// Coded without reference to an earlier packet of its type; a setup packet: the stream can be joined
  /// there.
  bool key = false;
  /// Position of the first picture that needs the packet; for an end packet the stream's end. If the stream
  /// leaves the scene before that picture, and returns, it is too early: as if the stream stayed.
  StreamPosition first;
  /// When it counts, 1/90000 s; none if not known. A pattern packet: the picture that its first pattern
  /// shows; sound: its first sample; any other: `first`.
  std::optional<std::uint64_t> time;
  std::uint64_t missing = 0;  ///< pictures that a setup, end or motion packet says are missing
};

/// Follows a stream packet by packet. AV1 data is not decoded.
class PacketTimes {
 public:
  /// @return errors of SceneReader::read() and of StreamClock, with the offset of the packet
  [[nodiscard]] Result<TimedPacket> take(const Packet& packet);
  /// Packets are missing.
  void lose();
  [[nodiscard]] bool has_losses() const { return reader_.has_losses(); }

  [[nodiscard]] bool has_setup() const { return reader_.has_setup(); }
  [[nodiscard]] const Setup& setup() const { return reader_.setup(); }  ///< the last one; has_setup() is true

  /// Behind the last picture that may be shown once all that was taken has come. Missing pictures count.
  [[nodiscard]] const StreamPosition& released() const { return clock_.now(); }

 private:
  // What a packet of each kind adds to `out`.
  Result<void> place(const Setup& setup, TimedPacket& out);
  Result<void> place(const Return& to, TimedPacket& out);
  Result<void> place(const End& end, TimedPacket& out);
  Result<void> place(const std::vector<ScenePattern>& patterns, TimedPacket& out);
  Result<void> place(const MotionGroup& group, TimedPacket& out);
  Result<void> place(const Unit& unit, TimedPacket& out) {
    auto placed = place(unit.motion, out);
    if (out.missing == 0) out.missing = static_cast<std::uint64_t>(unit.blend.missing);
    return placed;
  }
  static Result<void> place(const BlendGroup& group, TimedPacket& out);
  Result<void> place(const SoundGroup& group, TimedPacket& out);
  static Result<void> place(std::monostate /*unused*/, TimedPacket& out);
  static Result<void> place(const JoinedHead& /*head*/, TimedPacket& out) {
    out.key = true;
    return {};
  }
  /// Any other packet counts from the next picture on.
  template <class Syntax>
  Result<void> place(const Syntax& /*syntax*/, TimedPacket& /*out*/) {
    return {};
  }
  /// The clock has gone on to where the stream says that it is.
  Result<void> jump(const Result<std::uint64_t>& missing, TimedPacket& out);

  SceneReader reader_;
  StreamClock clock_;
};

}  // namespace fbs
