// The sound of a stream as it is coded, apart from its pictures.
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

/// Reads the sound packets of a stream, and its setup packets as far as these say which of them count (SPEC
/// 6.2, 6.3): the same parts that StreamDecoder::take_sound() gives, without decoding pictures to get there.
/// Errors are left to who decodes the pictures.
class SoundParts {
 public:
  /// @param bytes  the next ones of the stream, in pieces of any size
  void add(std::span<const std::uint8_t> bytes);

  /// Reads motion too from now on, for released(). Off by default, since it takes longer than all the rest.
  void follow_pictures() { lister_.emplace(); }
  /// End of the pictures that may be shown once all that was added has come, 1/90000 s: their sound has come.
  /// 0 without follow_pictures().
  [[nodiscard]] std::uint64_t released() const { return lister_ ? lister_->released() : 0; }

  /// In the order of the stream. Times need not rise where a stream is damaged.
  [[nodiscard]] const std::vector<SoundPart>& all() const { return parts_; }

 private:
  void take(const Packet& packet);

  PacketReader reader_;
  std::optional<PacketLister> lister_;
  bool damaged_ = false;             ///< the reader has to search
  bool lost_ = true;                 ///< a packet since the last setup packet
  std::optional<SoundSetup> setup_;  ///< of the scene
  std::int64_t next_ = 0;            ///< number of the first frame that has not come
  std::vector<SoundPart> parts_;
};

/// When its first frame is heard, 1/kSoundClock s; below 0 for what only prepares a decoder.
[[nodiscard]] std::int64_t begin_of(const SoundPart& part);
/// When its last frame ends.
[[nodiscard]] std::int64_t end_of(const SoundPart& part);

}  // namespace fbs
