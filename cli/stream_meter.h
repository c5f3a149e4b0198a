// Compares decoded pictures with the source, one at a time.
#pragma once

#include <cstdint>

#include "common/picture.h"
#include "common/quality.h"
#include "decoder/stream_decoder.h"

namespace fbs::cli {

/// Rate and distortion of a stream.
struct Measure {
  std::uint64_t pictures = 0;
  double seconds = 0;
  ByteCount bytes;
  SquaredError frame, face;              ///< luma; the face is the area inside the mesh's outline
  double ssim_frame = 0, ssim_face = 0;  ///< means over the pictures; 0 unless asked for

  [[nodiscard]] double kbps() const { return rate(bytes.total); }
  [[nodiscard]] double rate(std::uint64_t of_bytes) const {
    return seconds > 0 ? 8e-3 * static_cast<double>(of_bytes) / seconds : 0;
  }
};

/// Sums up the differences between decoded pictures and the source.
class StreamMeter {
 public:
  /// @param decoder  must outlive the object
  StreamMeter(StreamDecoder& decoder, bool with_ssim) : decoder_(decoder), with_ssim_(with_ssim) {}

  /// Compares the current picture of the decoder with `source`.
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
