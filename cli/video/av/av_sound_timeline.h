// Puts decoded sound at its timestamps. Part of the module fbs_av.
#pragma once

extern "C" {
#include <libswresample/swresample.h>
}

#include <cstdint>
#include <optional>
#include <vector>

#include "cli/video/av/av_support.h"
#include "common/result.h"

namespace fbs {

struct AvResamplerDeleter {
  void operator()(SwrContext* context) const { swr_free(&context); }
};
using AvResampler = std::unique_ptr<SwrContext, AvResamplerDeleter>;

/// Converts frames to interleaved 16-bit samples, with sample n at n / sample_rate. Times are in
/// 1/AV_TIME_BASE s. Slow drift is resampled away, by an inaudible 0.2 % at most.
class AvSoundTimeline {
 public:
  AvSoundTimeline(int sample_rate, int channels) : sample_rate_(sample_rate), channels_(channels) {}

  /// Call first for each frame: the format may change. Appends what is held back of the previous format.
  /// @return ErrorCode::kUnsupported when swresample does not take it
  Result<void> prepare(const AVFrame& frame, std::vector<std::int16_t>& out);

  /// Silence due before a frame that begins at `begin`; negative: samples to leave out at the frame's start.
  /// @return samples at the frame's rate; 0 within the tolerance
  [[nodiscard]] std::int64_t gap(const AVFrame& frame, std::int64_t begin) const;

  /// Appends silence in the frame's format and rate.
  void add_silence(const AVFrame& frame, int samples, std::vector<std::int16_t>& out);

  /// Appends the frame without its first `skipped` samples.
  void add(const AVFrame& frame, int skipped, std::vector<std::int16_t>& out);

  /// Learns the error of a frame's timestamp; for a frame about to be added without gap.
  Result<void> follow(const AVFrame& frame, std::int64_t begin, std::vector<std::int16_t>& out);

  /// Samples are missing before the next frame: it is placed exactly at its timestamp.
  void expect_gap() { exact_ = true; }

  /// Appends what the resampler holds back.
  void drain(std::vector<std::int16_t>& out);

 private:
  struct Format {
    int sample_format = AV_SAMPLE_FMT_NONE;
    int sample_rate = 0;
    int channels = 0;
    std::uint64_t mask = 0;
    friend bool operator==(const Format&, const Format&) = default;
  };
  static Format format_of(const AVFrame& frame);

  Result<void> open(const AVFrame& frame);
  /// @param data  null: drains
  void convert(const std::uint8_t** data, int samples, std::vector<std::int16_t>& out);
  [[nodiscard]] std::int64_t now() const;

  int sample_rate_;
  int channels_;
  Format format_;
  AvResampler resampler_;
  std::int64_t count_ = 0;            ///< samples per channel appended
  bool begun_ = false;                ///< resampler_ has received something
  bool exact_ = true;                 ///< the next frame is placed exactly at its timestamp
  bool adaptive_ = false;             ///< resampler_ can follow a drift
  double drift_ = 0;                  ///< mean lead of the timestamps over the samples, 1/AV_TIME_BASE s
  std::int64_t next_correction_ = 0;  ///< 1/AV_TIME_BASE s
};

}  // namespace fbs
