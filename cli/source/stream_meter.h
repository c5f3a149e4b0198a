// Compares decoded pictures with the source, one at a time.
#pragma once

#include <cstdint>

#include "common/picture.h"
#include "common/quality.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {

/// Rate and distortion of a stream.
struct Measure {
  std::uint64_t pictures = 0;
  double seconds = 0;
  ByteCount bytes;
  SquaredError frame, face;  ///< luma; the face is the area inside the mesh's outline

  [[nodiscard]] double kbps() const { return rate(bytes.total); }
  [[nodiscard]] double rate(std::uint64_t of_bytes) const {
    return seconds > 0 ? 8e-3 * static_cast<double>(of_bytes) / seconds : 0;
  }
};

/// What to measure of a stream.
enum class Measured : std::uint8_t {
  kRate,  ///< pictures, seconds and bytes in all
  kPsnr,  ///< everything; decoding takes a tenth of an encoder's time
};

/// Accumulates the pictures of a stream and their differences from the source.
class StreamMeter {
 public:
  /// @param decoder  must outlive the object
  explicit StreamMeter(StreamDecoder& decoder) : decoder_(decoder) {}

  /// Adds the current picture of the decoder, and compares it with `source`.
  Result<void> compare(const Picture& source);

  [[nodiscard]] Measure result() const;

 private:
  StreamDecoder& decoder_;
  Picture drawn_;
  Plane mask_;
  Measure sum_;
};

}  // namespace fbs::cli
