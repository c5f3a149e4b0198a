// Codes patterns as one low-delay AV1 sequence with libaom. SPEC 4.4.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

class PatternEncoder {
 public:
  /// @param format     of the stream; its range and matrix are written into the AV1 sequence header
  /// @param quantiser  AV1 quantiser on libaom's scale, 0..63, fixed for each picture
  static Result<PatternEncoder> create(const VideoFormat& format, int quantiser);

  /// @return one temporal unit without its delimiter
  Result<std::vector<std::uint8_t>> encode(const Picture& picture);

 private:
  struct Context;
  struct Deleter {
    void operator()(Context* c) const;
  };
  explicit PatternEncoder(std::unique_ptr<Context, Deleter> context) : context_(std::move(context)) {}
  std::unique_ptr<Context, Deleter> context_;
};

}  // namespace fbs
