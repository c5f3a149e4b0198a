// Patterns are one AV1 sequence, one coded frame each, shown or hidden. SPEC 4.4.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// Width or height of a reduced pattern.
constexpr int reduced_size(int full) {
  return (full + 1) / 2;
}

/// A coded frame's picture, and facts about the frame for the encoder.
struct DecodedFrame {
  Picture picture;         ///< of the stream's size
  bool reduced = false;    ///< it was coded at reduced size
  bool referable = false;  ///< later frames may refer to it
  int order_hint = 0;      ///< place in display order, modulo a power of two that the sequence header gives
};

/// Decodes patterns in the order they were coded, with dav1d on the calling thread.
class PatternDecoder {
 public:
  /// @param width, height  pixels, of the stream. A frame has this size or the reduced one; any other is an
  ///                       error, and takes no more memory than frames of this size
  static Result<PatternDecoder> create(int width, int height);

  /// @param av1  one frame OBU with all tiles, before it at most one sequence header; the last OBU may have
  ///             no size field
  /// @return the picture whether the frame is shown or hidden, enlarged when it is reduced; kInvalidStream
  /// when `av1` has other OBUs, or the frame is not 8-bit 4:2:0 of one of the two sizes or cannot be decoded
  Result<Picture> decode(std::span<const std::uint8_t> av1);

  /// The same with facts about the frame.
  Result<DecodedFrame> decode_frame(std::span<const std::uint8_t> av1);

 private:
  struct Context;
  struct Deleter {
    void operator()(Context* c) const;
  };
  explicit PatternDecoder(std::unique_ptr<Context, Deleter> context) : context_(std::move(context)) {}
  std::unique_ptr<Context, Deleter> context_;
};

}  // namespace fbs
