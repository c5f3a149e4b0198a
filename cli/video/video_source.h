// One interface to all sources of pictures: files, image sequences, pipes and cameras.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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

  /// The next picture, with a rising pts; nullopt at the clean end, also when called again. After the last
  /// readable picture: ErrorCode::kTruncated when the source is cut off, kInvalidStream when it is damaged,
  /// kIo when reading fails; kUnsupported when the picture size changes. After an error the source must not
  /// be used further.
  virtual Result<std::optional<TimedPicture>> next() = 0;

  /// Whether next() finds input, or its end, without waiting; true if unknown.
  /// @param patience  how long to wait here
  [[nodiscard]] virtual bool is_ready(std::chrono::milliseconds /*patience*/) const { return true; }

  /// Whether each picture lasts as format().frame_rate says; pts can be ignored.
  [[nodiscard]] virtual bool has_constant_rate() const { return false; }

  /// Number of pictures according to the container, for progress bars; nullopt when it does not say.
  [[nodiscard]] virtual std::optional<std::int64_t> frame_count_estimate() const = 0;

  /// Length according to the container, s, in whole pictures of the frame rate; nullopt when it does not say.
  [[nodiscard]] virtual std::optional<double> seconds_estimate() const {
    const auto pictures = frame_count_estimate();
    if (!pictures) return std::nullopt;
    return static_cast<double>(*pictures) * format().frame_rate.den / format().frame_rate.num;
  }

  /// Damaged packets skipped so far; worth a warning when not zero.
  [[nodiscard]] virtual std::int64_t damaged_packets() const { return 0; }

  /// What was done to the pictures so far that changes how they look, a line each: "HDR (HLG) tone-mapped to
  /// BT.709".
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
};

/// One of the notes().
inline constexpr const char* kOverBlack = "transparent parts are shown over black";

struct SourceOptions {
  Rational sequence_rate{25, 1};     ///< pictures per second of image sequences
  int decoder_threads = 1;           ///< at least 1
  int rotate = 0;                    ///< degrees clockwise: 0, 90, 180, 270
  const StopSignal* stop = nullptr;  ///< must outlive the source; interrupts a read that waits, with an error
};

}  // namespace fbs
