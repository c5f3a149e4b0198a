// What a decoder's log says: whatever a viewer would notice, once.
#pragma once

#include "common/hooks.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs {

class DecoderWatch {
 public:
  explicit DecoderWatch(const Hooks& hooks) : hooks_(hooks) {}

  /// A decoder with so many threads is open.
  void open(int threads) const;
  /// Compares the picture announced last with the one before.
  void note_picture(const StreamDecoder& stream);
  /// @param offset  in what has been fed, bytes
  void note_error(const Error& error, std::uint64_t offset) const;
  /// Pictures are no longer in a row.
  void reset() { quality_ = PictureQuality::kExact; }

 private:
  void note_scene(const StreamDecoder& stream) const;
  void note_quality(const StreamDecoder& stream) const;

  Hooks hooks_;
  PictureQuality quality_ = PictureQuality::kExact;  ///< of the picture before
};

}  // namespace fbs
