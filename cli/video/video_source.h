// One interface to the sources of pictures: files, image sequences, pipes and cameras.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

class StopSignal;

struct TimedPicture {
  Picture picture;
  std::int64_t pts = 0;  ///< presentation time, 1/90000 s from the start of the source; see timestamps.h
};

/// Pictures in presentation order, all of the same size. 8-bit 4:2:0 pictures are returned exactly as
/// decoded; other formats are converted. Errors name the input.
class VideoSource {
 public:
  virtual ~VideoSource() = default;

  /// Known once the source is open; width and height are within kMinPictureSize..kMaxPictureSize.
  /// For variable frame rates, frame_rate is the mean and pts gives the times.
  [[nodiscard]] virtual const VideoFormat& format() const = 0;

  /// The next picture, with a pts above the one before; nullopt at the clean end, and again if asked again.
  /// After the last picture that could be read: ErrorCode::kTruncated when the source is cut off,
  /// kInvalidStream when it is damaged, kIo when it cannot be read further; kUnsupported when the picture
  /// size changes. After an error the source must not be used further.
  virtual Result<std::optional<TimedPicture>> next() = 0;

  /// Whether next() finds input, or its end, without waiting for it; true where that is not known.
  /// @param patience  to wait for it here
  [[nodiscard]] virtual bool is_ready(std::chrono::milliseconds /*patience*/) const { return true; }

  /// Whether each picture lasts as long as format().frame_rate says; pts need not be looked at.
  [[nodiscard]] virtual bool has_constant_rate() const { return false; }

  /// Number of pictures according to the container, for progress bars; nullopt when it does not say.
  [[nodiscard]] virtual std::optional<std::int64_t> frame_count_estimate() const = 0;

  /// Damaged packets skipped so far; worth a warning when not zero.
  [[nodiscard]] virtual std::int64_t damaged_packets() const { return 0; }
};

struct SourceOptions {
  Rational sequence_rate{25, 1};  ///< pictures per second of image sequences
  int decoder_threads = 1;        ///< at least 1
  const StopSignal* stop =
      nullptr;  ///< must outlive the source; a read that waits ends with an error when it comes
};

}  // namespace fbs
