#include "encoder/patterns/pattern_encoder.h"

#include <utility>

namespace fbs {

Result<PatternEncoder> PatternEncoder::create(const VideoFormat& format, int quantiser, int speed) {
  Av1Settings settings;
  settings.quantiser = quantiser;
  settings.speed = speed;
  auto av1 = Av1Encoder::create(format, settings);
  if (!av1) return fail(av1.error());
  return PatternEncoder(std::move(*av1));
}

Result<std::vector<std::uint8_t>> PatternEncoder::encode(const Picture& picture) {
  auto frames = av1_.encode(picture);
  if (!frames) return fail(frames.error());
  if (frames->size() != 1) return fail(ErrorCode::kInternal, "libaom kept a pattern back");
  return std::move(frames->front());
}

}  // namespace fbs
