#include <gtest/gtest.h>

#include "bitstream/packet.h"
#include "bitstream/payload/sound_payload.h"
#include "decoder/stream/stream_decoder.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {
namespace {

constexpr SoundSetup kVoice{SoundCodec::kOpus, 1, 0, 960, 312};

/// A setup, then this many seconds of sound in the largest frames, and no picture.
std::vector<std::uint8_t> endless_sound(int seconds) {
  PacketReader reader;
  reader.feed(read_bytes(std::string(FBS_VECTORS) + "/talk.fbs"));
  const Packet setup = reader.next()->packet;
  std::vector<std::uint8_t> out;
  PacketWriter writer;
  write_signature(out);
  writer.write(out, setup.type, setup.payload);
  writer.write(out, PacketType::kSoundSetup, encode_sound_setup(kVoice).value());
  for (int k = 0; k < seconds; ++k) {
    SoundGroup group{k * 50, {}};
    group.frames.assign(50, std::vector<std::uint8_t>(kMaxSoundFrame));
    writer.write(out, PacketType::kSound, encode_sound(group, kVoice).value());
  }
  return out;
}

// What nobody takes must not fill the memory.
TEST(StreamDecoderSound, IsKeptUpToALimit) {
  const auto fit = static_cast<int>(kMaxSoundAhead / (50 * (64 + kMaxSoundFrame)));
  for (const bool taken : {false, true}) {
    StreamDecoder decoder;
    decoder.keep_sound();
    decoder.feed(endless_sound(fit + 3));
    int lost = 0;
    std::size_t parts = 0;
    for (auto status = decoder.next(); !status || *status != DecodeStatus::kNeedMore;
         status = decoder.next()) {
      if (status) continue;
      EXPECT_EQ(status.error().code, ErrorCode::kTooLarge);
      if (++lost == 1 && taken) parts += decoder.take_sound().size();
    }
    EXPECT_EQ(lost, taken ? 1 : 3);
    EXPECT_EQ(parts + decoder.take_sound().size(), static_cast<std::size_t>(fit + 3 - lost));
  }
}

}  // namespace
}  // namespace fbs
