// From pictures to a stream and back through the whole codec. Uses no test framework, so that programs which
// make vectors or measure can include it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decoder/stream/stream_decoder.h"
#include "encoder/encoder.h"

namespace fbs {

/// Encodes pictures into a whole stream.
/// @param picture    called with 0..count - 1, in order
/// @param durations  of the pictures, 1/90000 s; empty: the nominal one
/// @return the encoder's first error
template <class PictureAt>
Result<std::vector<std::uint8_t>> encode_pictures(const VideoFormat& format, const EncoderSettings& settings,
                                                  int count, PictureAt&& picture,
                                                  std::span<const std::uint32_t> durations = {}) {
  auto encoder = Encoder::create(format, settings);
  if (!encoder) return fail(encoder.error());
  std::vector<std::uint8_t> stream;
  const auto take = [&] {
    const auto bytes = encoder->take();
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  };
  for (int i = 0; i < count; ++i) {
    const std::uint32_t duration = durations.empty() ? 0 : durations[static_cast<std::size_t>(i)];
    if (auto pushed = encoder->push(picture(i), duration); !pushed) return fail(pushed.error());
    take();
  }
  if (auto finished = encoder->finish(); !finished) return fail(finished.error());
  take();
  return stream;
}

inline Result<std::vector<std::uint8_t>> encode_pictures(const VideoFormat& format,
                                                         const EncoderSettings& settings,
                                                         std::span<const Picture> pictures,
                                                         std::span<const std::uint32_t> durations = {}) {
  const auto at = [&](int i) -> const Picture& { return pictures[static_cast<std::size_t>(i)]; };
  return encode_pictures(format, settings, static_cast<int>(pictures.size()), at, durations);
}

/// Calls `see(decoder)` at each picture of what the decoder has.
/// @return kNeedMore or kEnd, or the first error
template <class See>
Result<DecodeStatus> decode_pictures(StreamDecoder& decoder, See&& see) {
  for (;;) {
    const auto status = decoder.next();
    if (!status || *status != DecodeStatus::kPicture) return status;
    see(decoder);
  }
}

/// The same for a whole stream.
template <class See>
Result<DecodeStatus> decode_pictures(std::span<const std::uint8_t> stream, See&& see) {
  StreamDecoder decoder;
  decoder.feed(stream);
  decoder.close();
  return decode_pictures(decoder, see);
}

}  // namespace fbs
