// Patterns in a closed loop: coded, and decoded again as every decoder will.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "decoder/pattern_decoder.h"
#include "encoder/patterns/pattern_encoder.h"

namespace fbs {

/// One pattern as it is sent and as it is shown.
struct CodedPattern {
  std::vector<std::uint8_t> av1;  ///< one temporal unit
  Picture decoded;
};

/// An AV1 encoder and the decoder that follows it. Lives as long as the scene, so that later patterns are
/// predicted from earlier ones.
class PatternCoder {
 public:
  /// As PatternEncoder::create.
  static Result<PatternCoder> create(const VideoFormat& format, int quantiser);

  Result<CodedPattern> code(const Picture& picture);

 private:
  PatternCoder(PatternEncoder encoder, PatternDecoder decoder)
      : encoder_(std::move(encoder)), decoder_(std::move(decoder)) {}

  PatternEncoder encoder_;
  PatternDecoder decoder_;
};

/// A scene's first pattern while its quantiser is being chosen. Each quantiser is coded once; only sizes are
/// kept, and the coder of the last, since an AV1 encoder of a large picture takes hundreds of megabytes.
class FirstPattern {
 public:
  /// @param picture  must outlive the object
  FirstPattern(const VideoFormat& format, const Picture& picture) : format_(format), picture_(&picture) {}

  /// Bytes of the pattern at a quantiser, 0..63.
  Result<std::size_t> bytes(int quantiser);

  /// The coder that has coded the first pattern, and the pattern.
  struct Coded {
    PatternCoder coder;
    CodedPattern pattern;
  };
  /// Leaves nothing behind.
  Result<Coded> take(int quantiser);

 private:
  Result<void> code(int quantiser);

  VideoFormat format_;
  const Picture* picture_;
  std::map<int, std::size_t> bytes_;
  int last_quantiser_ = -1;
  std::optional<Coded> last_;
};

}  // namespace fbs
