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

/// What of a stream is measured. Drawing its pictures to compare them takes a tenth of an encoder's time,
/// SSIM longer than encoding.
enum class Measured : std::uint8_t {
  kRate,
  kPsnr,  ///< and the rate
  kSsim,  ///< and both
};

/// Sums up the pictures of a stream and their differences from the source.
class StreamMeter {
 public:
  /// @param decoder  must outlive the object
  StreamMeter(StreamDecoder& decoder, Measured what)
      : decoder_(decoder), with_ssim_(what == Measured::kSsim) {}

  /// Adds the current picture of the decoder.
  void add();
  /// The same, and compares it with `source`.
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
