// Codes patterns one by one with libaom, without delay. SPEC 4.4.
#pragma once

#include <cstdint>
#include <vector>

#include "encoder/patterns/av1_encoder.h"

namespace fbs {

class PatternEncoder {
 public:
  /// @param format     of the stream; its range and matrix are written into the AV1 sequence header
  /// @param quantiser  AV1 quantiser on libaom's scale, 0..63, fixed for each picture
  /// @param speed      as Av1Settings::speed
  static Result<PatternEncoder> create(const VideoFormat& format, int quantiser, int speed = kSentSpeed);

  /// @return one coded frame, as PatternDecoder reads it
  Result<std::vector<std::uint8_t>> encode(const Picture& picture);

 private:
  explicit PatternEncoder(Av1Encoder av1) : av1_(std::move(av1)) {}
  Av1Encoder av1_;
};

}  // namespace fbs
