// Codes a live scene's patterns one by one, without look-ahead: an AV1 sequence that goes on as long as the
// scene.
#pragma once

#include <optional>

#include "common/picture.h"
#include "common/result.h"
#include "decoder/pattern/pattern_decoder.h"
#include "encoder/patterns/av1_encoder.h"
#include "encoder/patterns/pattern_sequence.h"

namespace fbs {

class LiveSequence {
 public:
  /// @param reduced  code at half width and height
  /// @param alone    each pattern needs the scene's first alone
  LiveSequence(const VideoFormat& format, bool reduced, bool alone);

  void begin_scene();
  /// A viewer has lost a pattern for good: later ones of the scene need its first alone.
  void lose_patterns();
  [[nodiscard]] bool alone() const { return alone_; }

  /// The size at which pictures are coded.
  [[nodiscard]] const VideoFormat& coded_format() const { return coded_; }
  /// A picture of full size as it is coded.
  [[nodiscard]] Picture to_coded_size(Picture picture) const;

  /// Codes the scene's next pattern.
  /// @param picture    of full size
  /// @param quantiser  libaom's scale, 0..63
  [[nodiscard]] Result<SequencePattern> code(Picture picture, int quantiser);
  /// Codes the scene's first pattern for no more than so many bytes: see code_start_pattern(). The next one
  /// begins an AV1 sequence of its own, since predicted from so coarse a pattern it takes as many bytes.
  /// @param picture  of full size
  /// @param finest   quantiser that is fine enough
  [[nodiscard]] Result<SequencePattern> code_start(const Picture& picture, int finest, std::size_t bytes);
  /// This much of the video has passed: time to code more.
  void pass(double seconds);

 private:
  /// libaom's speed for the next pattern: hasty where many have been coded lately.
  [[nodiscard]] int speed() const;
  /// Begins an AV1 sequence.
  Result<void> open(int quantiser, int speed);
  /// @param picture  of the coded size
  [[nodiscard]] Result<SequencePattern> code_next(const Picture& picture);

  /// An AV1 sequence, and what the decoder makes of it.
  struct Codec {
    Av1Encoder encoder;
    PatternDecoder decoder;
  };

  VideoFormat format_, coded_;
  bool always_alone_, alone_;
  double coded_lately_ = 0;  ///< patterns, less those for which there has been time since
  std::optional<Codec> codec_;
  struct First {
    Picture picture;  ///< empty: the scene has no pattern
    int quantiser, speed;
    bool coarse;  ///< by code_start()
  } first_{};     ///< pattern, as it was coded
};

}  // namespace fbs
