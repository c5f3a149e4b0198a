#include "decoder/sound/opus_packet.h"

#include <opus/opus.h>

#include <algorithm>

#include "bitstream/sound_syntax.h"

namespace fbs {

std::int32_t opus_duration(std::span<const std::uint8_t> packet) {
  if (packet.empty()) return 0;
  return std::max(
      opus_packet_get_nb_samples(packet.data(), static_cast<opus_int32>(packet.size()), kSoundClock), 0);
}

}  // namespace fbs
