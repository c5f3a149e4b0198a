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

  /// The finest quantiser, `from`..63, at which the pattern takes no more than so many bytes; 63 if none is
  /// coarse enough.
  Result<int> finest_within(std::size_t bytes, int from);

  /// Bytes by quantiser, of all that have been coded.
  [[nodiscard]] const std::map<int, std::size_t>& tried() const { return bytes_; }

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

struct StartPatternSettings {
  int finest = 0;           ///< quantiser, libaom's scale, that is fine enough
  bool reduced = false;     ///< at half width and height in any case
  int speed = kTrialSpeed;  ///< as Av1Settings::speed
};

/// Codes a picture, as an AV1 sequence of its own, for no more than so many bytes: as coarse as that takes,
/// and at half width and height where full size takes more at its coarsest. Where both fit, at 300 bytes, the
/// picture is as near to its source at full size. Half size at its coarsest may take more bytes.
/// @return the decoded picture of full size
[[nodiscard]] Result<CodedPattern> code_start_pattern(const VideoFormat& format, const Picture& picture,
                                                      const StartPatternSettings& settings,
                                                      std::size_t bytes);

}  // namespace fbs
