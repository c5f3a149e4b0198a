#include "encoder/patterns/first_pattern.h"

#include <algorithm>
#include <utility>

#include "decoder/pattern/pattern_decoder.h"
#include "decoder/pattern/upscale.h"
#include "encoder/patterns/downscale.h"
#include "encoder/patterns/pattern_encoder.h"

namespace fbs {

Result<void> FirstPattern::code(int quantiser) {
  if (last_ && last_quantiser_ == quantiser) return {};
  auto encoder = PatternEncoder::create(format_, quantiser, speed_);
  if (!encoder) return fail(encoder.error());
  auto av1 = encoder->encode(*picture_);
  if (!av1) return fail(av1.error());
  auto decoder = PatternDecoder::create(format_.width, format_.height);
  if (!decoder) return fail(decoder.error());
  auto decoded = decoder->decode(*av1);
  if (!decoded) return fail(decoded.error());
  bytes_[quantiser] = av1->size();
  last_quantiser_ = quantiser;
  last_.emplace(CodedPattern{std::move(*av1), std::move(*decoded)});
  return {};
}

Result<std::size_t> FirstPattern::bytes(int quantiser) {
  if (!bytes_.contains(quantiser))
    if (auto coded = code(quantiser); !coded) return fail(coded.error());
  return bytes_[quantiser];
}

Result<int> FirstPattern::finest_within(std::size_t bytes, int from) {
  const auto wanted = this->bytes(from);  // which often fits
  if (!wanted) return fail(wanted.error());
  if (*wanted <= bytes) return from;
  int low = std::min(from + 1, kMaxQuantiser), high = kMaxQuantiser;
  while (low < high) {
    const int middle = (low + high) / 2;
    const auto taken = this->bytes(middle);
    if (!taken) return fail(taken.error());
    if (*taken <= bytes)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

Result<CodedPattern> FirstPattern::take(int quantiser) {
  if (auto coded = code(quantiser); !coded) return fail(coded.error());
  CodedPattern out = std::move(*last_);
  last_.reset();
  return out;
}

Result<CodedPattern> code_start_pattern(const VideoFormat& format, const Picture& picture,
                                        const StartPatternSettings& settings, std::size_t bytes) {
  if (!settings.reduced) {
    FirstPattern full(format, picture, settings.speed);
    const auto coarsest = full.bytes(kMaxQuantiser);
    if (!coarsest) return fail(coarsest.error());
    if (*coarsest <= bytes) {
      const auto quantiser = full.finest_within(bytes, settings.finest);
      return quantiser ? full.take(*quantiser) : fail(quantiser.error());
    }
  }
  VideoFormat size = format;
  size.width = reduced_size(format.width);
  size.height = reduced_size(format.height);
  const Picture small = downscaled(picture);
  FirstPattern half(size, small, settings.speed);
  const auto quantiser = half.finest_within(bytes, settings.finest);
  if (!quantiser) return fail(quantiser.error());
  auto out = half.take(*quantiser);
  if (out) out->decoded = upscaled(out->decoded, format.width, format.height);
  return out;
}

}  // namespace fbs
