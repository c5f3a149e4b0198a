#include "library/decoder_watch.h"

#include <string>

#include "decoder/scene/scene_face.h"
#include "decoder/vectors/scalar.h"

namespace fbs {
namespace {

std::string picture_number(const StreamDecoder& stream) {
  return "picture " + std::to_string(stream.position().pictures) + ": ";
}

}  // namespace

void DecoderWatch::open(int threads) const {
  if (hooks_.logs())
    hooks_.say(LogLevel::kDebug,
               std::string("decoder: kernels ") + kernel_name() + ", threads " + std::to_string(threads));
}

void DecoderWatch::note_picture(const StreamDecoder& stream) {
  if (!hooks_.logs()) return;
  if (!stream.held() && stream.state().picture == 0) note_scene(stream);
  if (quality_ != stream.quality()) {
    quality_ = stream.quality();
    note_quality(stream);
  }
}

void DecoderWatch::note_error(const Error& error, std::uint64_t offset) const {
  if (hooks_.logs())
    hooks_.say(LogLevel::kWarning,
               "byte " + std::to_string(offset) + ": " + error.text + "; decoding goes on behind it");
}

void DecoderWatch::note_scene(const StreamDecoder& stream) const {
  const VideoFormat& format = stream.format();
  hooks_.say(LogLevel::kInfo, picture_number(stream) + "a scene of " + std::to_string(format.width) + "x" +
                                  std::to_string(format.height) + " begins, " +
                                  (face_of(stream.scene()) != nullptr ? "with a face" : "without a face"));
}

void DecoderWatch::note_quality(const StreamDecoder& stream) const {
  const auto say = [&](LogLevel level, const char* text) {
    hooks_.say(level, picture_number(stream) + text);
  };
  switch (quality_) {
    case PictureQuality::kExact:
      return say(LogLevel::kInfo, "exact again");
    case PictureQuality::kPatternMissing:
      return say(LogLevel::kWarning, "drawn without a pattern that is missing");
    case PictureQuality::kInterpolated:
      return say(LogLevel::kWarning, "its motion is missing and is interpolated");
    case PictureQuality::kHeld:
      return say(LogLevel::kWarning, "missing; the one before is repeated");
  }
}

}  // namespace fbs
