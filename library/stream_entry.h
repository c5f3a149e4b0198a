// The beginning of a stream as callers feed it: with its signature or, to join it at a scene, without.
#pragma once

#include <cstdint>
#include <span>

#include "decoder/stream/stream_decoder.h"

namespace fbs {

/// Feeds a decoder, and supplies the signature where that is left out. Bytes that are as those of the
/// signature so far are held back: only the next one may tell.
class StreamEntry {
 public:
  /// @param may_lack_signature  false: what begins without is passed on as it is, and is no stream
  explicit StreamEntry(bool may_lack_signature) : decided_(!may_lack_signature) {}

  /// Strong exception guarantee.
  void feed(StreamDecoder& decoder, std::span<const std::uint8_t> bytes);
  void close(StreamDecoder& decoder);

  /// What a decoder's offset is in the bytes that were fed.
  [[nodiscard]] std::uint64_t fed_offset(std::uint64_t offset) const {
    const std::uint64_t supplied = supplied_ ? kSignature.size() : 0;
    return offset < supplied ? 0 : offset - supplied;
  }

 private:
  bool decided_;
  bool supplied_ = false;
  std::size_t held_ = 0;  // bytes, those of the signature
};

}  // namespace fbs
