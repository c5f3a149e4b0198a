// Puts sound into a stream, each part before the pictures that it belongs to. SPEC 6.3.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bitstream/packet.h"
#include "bitstream/sound_syntax.h"
#include "common/result.h"
#include "decoder/stream/packet_times.h"

namespace fbs::cli {

/// The frames of sound that begin before a time and have not been returned yet, in order. A group may have
/// any number of frames.
/// @param before  1/kSoundClock s from the first picture
using SoundFeed = std::function<Result<std::vector<SoundGroup>>(std::int64_t before)>;

/// Takes a stream without sound and returns it with sound. Its packets stay as they are. The setup of the
/// sound follows each packet behind which a scene may begin.
class SoundInterleaver {
 public:
  /// @param setup  is_valid()
  SoundInterleaver(const SoundSetup& setup, SoundFeed feed) : setup_(setup), feed_(std::move(feed)) {}

  /// @param bytes  the next ones of the stream, in pieces of any size
  /// @return the bytes that are ready; errors of PacketReader and of the feed; kInvalidArgument if it has
  /// sound
  Result<std::vector<std::uint8_t>> add(std::span<const std::uint8_t> bytes);

 private:
  Result<void> take(const Packet& packet, std::vector<std::uint8_t>& out);
  Result<void> add_sound(std::int64_t before, std::vector<std::uint8_t>& out);

  SoundSetup setup_;
  SoundFeed feed_;
  PacketReader reader_;
  PacketTimes times_;
  PacketWriter writer_;
  bool begun_ = false;
};

}  // namespace fbs::cli
