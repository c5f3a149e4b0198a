#include "encoder/patterns/pattern_coder.h"

#include <utility>

namespace fbs {

Result<PatternCoder> PatternCoder::create(const VideoFormat& format, int quantiser) {
  auto encoder = PatternEncoder::create(format, quantiser);
  if (!encoder) return fail(encoder.error());
  auto decoder = PatternDecoder::create(format.width, format.height);
  if (!decoder) return fail(decoder.error());
  return PatternCoder(std::move(*encoder), std::move(*decoder));
}

Result<CodedPattern> PatternCoder::code(const Picture& picture) {
  auto av1 = encoder_.encode(picture);
  if (!av1) return fail(av1.error());
  auto decoded = decoder_.decode(*av1);
  if (!decoded) return fail(decoded.error());
  return CodedPattern{std::move(*av1), std::move(*decoded)};
}

Result<void> FirstPattern::code(int quantiser) {
  if (last_ && last_quantiser_ == quantiser) return {};
  auto coder = PatternCoder::create(format_, quantiser);
  if (!coder) return fail(coder.error());
  auto pattern = coder->code(*picture_);
  if (!pattern) return fail(pattern.error());
  bytes_[quantiser] = pattern->av1.size();
  last_quantiser_ = quantiser;
  last_.emplace(Coded{std::move(*coder), std::move(*pattern)});
  return {};
}

Result<std::size_t> FirstPattern::bytes(int quantiser) {
  if (!bytes_.contains(quantiser))
    if (auto coded = code(quantiser); !coded) return fail(coded.error());
  return bytes_[quantiser];
}

Result<FirstPattern::Coded> FirstPattern::take(int quantiser) {
  if (auto coded = code(quantiser); !coded) return fail(coded.error());
  Coded out = std::move(*last_);
  last_.reset();
  return out;
}

}  // namespace fbs
