// One interface to all sources of pictures: files, image sequences, pipes and cameras.
#pragma once

#include <array>
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

  /// Damaged packets skipped so far; worth a warning when not zero.
  [[nodiscard]] virtual std::int64_t damaged_packets() const { return 0; }
};

struct SourceOptions {
  Rational sequence_rate{25, 1};     ///< pictures per second of image sequences
  int decoder_threads = 1;           ///< at least 1
  const StopSignal* stop = nullptr;  ///< must outlive the source; interrupts a read that waits, with an error
};

/// Whether `input` names a numbered sequence, several images or a folder of them.
bool is_image_sequence(const std::string& input);

/// The first bytes of Matroska files: the ID of their first element.
inline constexpr std::array<std::uint8_t, 4> kEbmlHead{0x1A, 0x45, 0xDF, 0xA3};

/// Whether this is a stream, or a Matroska file with one. False for pipes, which are not read.
bool is_stream_file(const std::string& name);

/// Opens `input`:
///   `-`                       Y4M on standard input
///   `name.y4m`                Y4M
///   `camera:N`                camera N through OpenCV
///   `frame_%05d.png`, `*.png` with `*` or `?`, or a folder
///                             image sequence through OpenImageIO, in order of number, then name
///   anything else             libav: every container, codec and address that ffmpeg opens
/// Rotated phone video is put upright; grey, 4:2:2, 4:4:4, more than 8 bits and RGB become 8-bit 4:2:0.
///
/// @return ErrorCode::kIo when it cannot be read, kUnsupported when it contains no video that we support,
///         kTooLarge when the pictures are outside the size limits
Result<std::unique_ptr<VideoSource>> open_video_source(const std::string& input,
                                                       const SourceOptions& options = {});

}  // namespace fbs
