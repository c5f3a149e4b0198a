#include "encoder/patterns/first_pattern.h"

#include <utility>

#include "decoder/pattern/pattern_decoder.h"
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

Result<CodedPattern> FirstPattern::take(int quantiser) {
  if (auto coded = code(quantiser); !coded) return fail(coded.error());
  CodedPattern out = std::move(*last_);
  last_.reset();
  return out;
}

}  // namespace fbs
