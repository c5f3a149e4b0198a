// Encodes a source and measures the result: shared by `encode` and `evaluate`.
#pragma once

#include <functional>

#include "cli/stream_meter.h"
#include "cli/verbs.h"
#include "cli/video/video_source.h"
#include "encoder/encoder.h"

namespace fbs::cli {

using TakeBytes = std::function<Result<void>(std::span<const std::uint8_t>)>;
using SeePicture = std::function<Result<void>(const TimedPicture&, const PictureAnalysis&)>;

/// Encodes all of `source`, passes each piece of the stream to `take`, decodes it and measures it.
/// @param see  called with every picture after its analysis; may be empty
[[nodiscard]] Result<Measure> encode_source(VideoSource& source, const EncoderSettings& settings,
                                            const TakeBytes& take, const SeePicture& see, Measured what,
                                            bool quiet);

}  // namespace fbs::cli
