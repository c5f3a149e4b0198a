// The coded sound of a stream, without its pictures.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/packet.h"
#include "bitstream/sound_syntax.h"
#include "decoder/stream/packet_list.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs {

/// Reads the sound packets of a stream, and its setup packets as far as they decide which sound counts (SPEC
/// 6.2, 6.3): the same parts as StreamDecoder::take_sound(), without decoding pictures. Errors are left to
/// the decoder of the pictures.
class SoundParts {
 public:
  /// @param bytes  the next ones of the stream, in pieces of any size
  void add(std::span<const std::uint8_t> bytes);

  /// Reads motion too from now on, for released(). Off by default, since it takes longer than everything
  /// else.
  void follow_pictures() { lister_.emplace(); }
  /// End of the pictures that may be shown, given what has been added, 1/90000 s: their sound has arrived. 0
  /// without follow_pictures().
  [[nodiscard]] std::uint64_t released() const { return lister_ ? lister_->released() : 0; }

  /// All parts in the order of the stream. In a damaged stream times may not rise.
  [[nodiscard]] const std::vector<SoundPart>& all() const { return parts_; }

 private:
  void take(const Packet& packet);

  PacketReader reader_;
  std::optional<PacketLister> lister_;
  bool damaged_ = false;             ///< the reader has to search
  bool lost_ = true;                 ///< a packet since the last setup packet was lost
  std::optional<SoundSetup> setup_;  ///< the scene's
  std::int64_t next_ = 0;            ///< number of the first frame that has not arrived
  std::vector<SoundPart> parts_;
};

/// When its first frame is heard, 1/kSoundClock s; below 0 if it only prepares a decoder.
[[nodiscard]] std::int64_t begin_of(const SoundPart& part);
/// When its last frame ends.
[[nodiscard]] std::int64_t end_of(const SoundPart& part);

}  // namespace fbs
