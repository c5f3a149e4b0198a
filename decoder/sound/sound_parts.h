// The coded sound of a stream, without its pictures.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/packet.h"
#include "bitstream/scene/scene_reader.h"
#include "bitstream/sound_syntax.h"
#include "decoder/stream/packet_times.h"
#include "decoder/stream/sound_inbox.h"

namespace fbs {

/// Reads the sound packets of a stream, and its setup packets as far as they decide which sound counts (SPEC
/// 6.2, 6.3): the same parts as StreamDecoder::take_sound(), without decoding pictures. Errors are left to
/// the decoder of the pictures.
class SoundParts {
 public:
  /// @param bytes  the next ones of the stream, in pieces of any size
  void add(std::span<const std::uint8_t> bytes);

  /// Reads motion too from now on, for released(), and joins a scene by the parts of its head (SPEC 6.5). Off
  /// by default, since it takes longer than all the rest.
  void follow_pictures() { pictures_.emplace(); }
  /// End of the pictures that may be shown once all that was added has come, 1/90000 s: their sound has come.
  /// 0 without follow_pictures().
  [[nodiscard]] std::uint64_t released() const { return pictures_ ? pictures_->released().time : 0; }

  /// Bytes of the sound packets, also of those that do not count.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

  /// All parts in the order of the stream. In a damaged stream times may not rise.
  [[nodiscard]] const std::vector<SoundPart>& all() const { return parts_; }

 private:
  void take(const Packet& packet);

  PacketReader packets_;
  SceneReader reader_;                   ///< sees no packets of pictures
  std::optional<PacketTimes> pictures_;  ///< sees them
  std::vector<SoundPart> parts_;
  std::uint64_t bytes_ = 0;
};

/// When its first frame is heard, 1/kSoundClock s; below 0 if it only prepares a decoder.
[[nodiscard]] std::int64_t begin_of(const SoundPart& part);
/// When its last frame ends.
[[nodiscard]] std::int64_t end_of(const SoundPart& part);

}  // namespace fbs
