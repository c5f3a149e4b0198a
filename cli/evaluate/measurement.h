// Compares the pictures of a stream with its source.
#pragma once

#include <string>
#include <vector>

#include "cli/evaluate/quality/face_regions.h"
#include "cli/evaluate/quality/shown_pictures.h"
#include "cli/evaluate/rate_distortion/rd_point.h"
#include "cli/files/stop_signal.h"
#include "cli/source/source_part.h"
#include "common/result.h"

namespace fbs::cli {

/// The setting that all streams of a source share.
struct MeasurementSetting {
  std::string source;
  PartLimits limits;
  const FaceRegions* regions = nullptr;
  bool vmaf = false;
  bool quiet = false;  ///< no progress bar
  const StopSignal* stop = nullptr;
};

/// Fills `point.pictures` and `point.vmaf`. A truncated source is measured as far as it goes.
/// @param log  name of a file that ffmpeg may write
/// @return the source, read to its end; kInvalidArgument when size or number of the pictures differ from its
/// own
Result<SourcePart> measure_pictures(const MeasurementSetting& setting, ShownPictures& shown,
                                    const std::string& log, RdPoint& point);

}  // namespace fbs::cli
