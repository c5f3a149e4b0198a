#include "decoder/sound/sound_decoder.h"

#include "decoder/sound/codec2_sound.h"
#include "decoder/sound/opus_sound.h"

namespace fbs {

Result<std::unique_ptr<SoundDecoder>> SoundDecoder::create(const SoundSetup& setup) {
  if (setup.skip < 0 || setup.skip > kMaxSoundSkip)
    return fail(ErrorCode::kInvalidStream, "the sound begins too long before the pictures");
  switch (setup.codec) {
    case SoundCodec::kOpus:
      return create_opus_sound(setup);
    case SoundCodec::kCodec2:
      return create_codec2_sound(setup);
  }
  return fail(ErrorCode::kUnsupported, "the sound is of an unknown codec");
}

}  // namespace fbs
