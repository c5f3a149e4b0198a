// Compares a stream's pictures with the source's while both pass by.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/picture.h"
#include "common/quality.h"
#include "decoder/stream_decoder.h"

namespace fbs::cli {

/// What a stream costs and how near it comes.
struct Measure {
  std::uint64_t pictures = 0;
  double seconds = 0;
  ByteCount bytes;
  SquaredError frame, face;              ///< luma; the face is the area of the decoded mesh
  double ssim_frame = 0, ssim_face = 0;  ///< means over the pictures; 0 unless asked for

  [[nodiscard]] double kbps() const { return rate(bytes.total); }
  [[nodiscard]] double rate(std::uint64_t of_bytes) const {
    return seconds > 0 ? 8e-3 * static_cast<double>(of_bytes) / seconds : 0;
  }
};

/// Compares what a decoder shows with the source, picture by picture.
class StreamMeter {
 public:
  /// @param decoder  must outlive the object
  StreamMeter(StreamDecoder& decoder, bool with_ssim) : decoder_(decoder), with_ssim_(with_ssim) {}

  /// Compares the picture that the decoder announces with `source`.
  Result<void> compare(const Picture& source);

  [[nodiscard]] Measure result() const;

 private:
  StreamDecoder& decoder_;
  bool with_ssim_;
  Picture drawn_;
  Plane mask_;
  Measure sum_;
};

}  // namespace fbs::cli
