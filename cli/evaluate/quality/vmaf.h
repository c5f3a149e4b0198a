// VMAF by the libvmaf of an installed ffmpeg.
#pragma once

#include <optional>
#include <string>

#include "cli/evaluate/peers/child_process.h"
#include "common/picture.h"
#include "common/result.h"

namespace fbs::cli {

/// Whether ffmpeg is there and has the filter libvmaf.
[[nodiscard]] bool has_vmaf();

/// VMAF of a whole stream. Both pictures go to one ffmpeg, one above the other.
class VmafMeter {
 public:
  /// @param width, height  of the pictures
  /// @param log            ffmpeg writes `log` and `log`.json
  static Result<VmafMeter> start(int width, int height, const std::string& log);

  /// @param source, shown  of the size above
  Result<void> add(const Picture& source, const Picture& shown);
  /// @return the mean over all pictures, 0..100
  Result<double> finish();

 private:
  VmafMeter(ChildProcess ffmpeg, std::string log) : ffmpeg_(std::move(ffmpeg)), log_(std::move(log)) {}

  ChildProcess ffmpeg_;
  std::string log_;
};

}  // namespace fbs::cli
