// Puts decoded sound where its timestamps say. Part of the module fbs_av.
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

/// Converts frames to interleaved 16-bit samples of which number n is at n / sample_rate. Times are
/// in 1/AV_TIME_BASE s. Slow drift is resampled away, by 0.2 % at most, which is not heard.
class AvSoundTimeline {
 public:
  AvSoundTimeline(int sample_rate, int channels) : sample_rate_(sample_rate), channels_(channels) {}

  /// Must be called before the others, for each frame: the format may change. What is held back of the format
  /// before is appended.
  /// @return ErrorCode::kUnsupported when swresample does not take it
  Result<void> prepare(const AVFrame& frame, std::vector<std::int16_t>& out);

  /// Silence due before a frame that begins at `begin`; negative: what is left out at the frame's start.
  /// @return samples of the frame's rate; 0 for what is within the tolerance
  [[nodiscard]] std::int64_t gap(const AVFrame& frame, std::int64_t begin) const;

  /// Appends silence in the frame's format and rate.
  void add_silence(const AVFrame& frame, int samples, std::vector<std::int16_t>& out);

  /// Appends the frame but for the first `skipped` samples.
  void add(const AVFrame& frame, int skipped, std::vector<std::int16_t>& out);

  /// Learns from a frame that is about to be added without gap how far its timestamp is off.
  Result<void> follow(const AVFrame& frame, std::int64_t begin, std::vector<std::int16_t>& out);

  /// Samples are missing before the next frame: it is put exactly where its timestamp says.
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
  std::int64_t count_ = 0;  ///< of samples of one channel appended
  bool begun_ = false;      ///< something was given to resampler_
  bool exact_ = true;       ///< the next frame goes exactly where its timestamp says
  bool adaptive_ = false;   ///< resampler_ can follow a drift
  double drift_ = 0;        ///< mean by which the timestamps are ahead of the samples, 1/AV_TIME_BASE s
  std::int64_t next_correction_ = 0;  ///< 1/AV_TIME_BASE s
};

}  // namespace fbs
