// The beginning of a stream as callers feed it: with its signature or, to join at a scene, without.
#pragma once

#include <cstdint>
#include <span>

#include "decoder/stream/stream_decoder.h"

namespace fbs {

/// Feeds a decoder, and supplies the signature where it is left out. Bytes equal to the signature so far are
/// held back until the next byte decides.
class StreamEntry {
 public:
  /// @param may_lack_signature  false: a beginning without signature is passed on, and is not a stream
  explicit StreamEntry(bool may_lack_signature) : decided_(!may_lack_signature) {}

  /// Strong exception guarantee.
  void feed(StreamDecoder& decoder, std::span<const std::uint8_t> bytes);
  void close(StreamDecoder& decoder);

  /// The position among the bytes fed of a decoder's offset.
  [[nodiscard]] std::uint64_t fed_offset(std::uint64_t offset) const {
    const std::uint64_t supplied = supplied_ ? kSignature.size() : 0;
    return offset < supplied ? 0 : offset - supplied;
  }

 private:
  bool decided_;
  bool supplied_ = false;
  std::size_t held_ = 0;  // bytes, equal to the signature's
};

}  // namespace fbs
