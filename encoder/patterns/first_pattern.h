// A scene's first pattern while its quantiser is being chosen.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "common/picture.h"
#include "common/result.h"
#include "encoder/patterns/av1_encoder.h"

namespace fbs {

/// A pattern as coded and as shown.
struct CodedPattern {
  std::vector<std::uint8_t> av1;  ///< as PatternDecoder reads it
  Picture decoded;
};

/// Codes each quantiser once; keeps sizes only, and the last pattern.
class FirstPattern {
 public:
  /// @param picture  must outlive the object
  /// @param speed    as Av1Settings::speed
  FirstPattern(const VideoFormat& format, const Picture& picture, int speed = kSentSpeed)
      : format_(format), picture_(&picture), speed_(speed) {}

  /// Bytes of the pattern at a quantiser, 0..63.
  Result<std::size_t> bytes(int quantiser);

  /// Takes the pattern out; call last.
  Result<CodedPattern> take(int quantiser);

 private:
  Result<void> code(int quantiser);

  VideoFormat format_;
  const Picture* picture_;
  int speed_;
  std::map<int, std::size_t> bytes_;
  int last_quantiser_ = -1;
  std::optional<CodedPattern> last_;
};

}  // namespace fbs
