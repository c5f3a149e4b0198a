// Patterns are one low-delay AV1 sequence, one temporal unit each. SPEC 4.4.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// Decodes patterns in the order they were coded, with dav1d on the calling thread.
class PatternDecoder {
 public:
  /// @param width, height  pixels; a pattern of another size is an error, and no more memory than for one of
  /// this
  ///                       size is taken
  static Result<PatternDecoder> create(int width, int height);

  /// @param av1  one temporal unit
  /// @return the picture; kInvalidStream when it is not 8-bit 4:2:0 of the right size or cannot be decoded
  Result<Picture> decode(std::span<const std::uint8_t> av1);

 private:
  struct Context;
  struct Deleter {
    void operator()(Context* c) const;
  };
  explicit PatternDecoder(std::unique_ptr<Context, Deleter> context) : context_(std::move(context)) {}
  std::unique_ptr<Context, Deleter> context_;
};

}  // namespace fbs
