// Encodes a source and measures the result: shared by `encode` and `evaluate`.
#pragma once

#include <functional>
#include <string>

#include "cli/source/stream_meter.h"
#include "cli/stream/sound_interleaver.h"
#include "cli/video/video_source.h"
#include "encoder/encoder.h"

namespace fbs::cli {

using TakeBytes = std::function<Result<void>(std::span<const std::uint8_t>)>;
using SeePicture = std::function<Result<void>(const TimedPicture&, const PictureAnalysis&)>;

struct Encoded {
  Measure measure;
  EncodingReport report;
};

/// Encodes all of `source`, passes each piece of the stream to `take`, and measures it. Says so, unless
/// `quiet`, as soon as a face is found that lies on its side.
/// @param see    called with every picture after its analysis; may be empty
/// @param sound  puts it into the stream; null: the stream has none
[[nodiscard]] Result<Encoded> encode_source(VideoSource& source, const EncoderSettings& settings,
                                            const TakeBytes& take, const SeePicture& see, Measured what,
                                            bool quiet, SoundInterleaver* sound = nullptr);

/// Says on standard error that the pictures should be turned.
/// @param degrees  Encoder::turn_to_upright()
void print_turn_warning(int degrees);

/// Notes for the user on a video with cuts, or in which no face could be tracked: a line, or nothing.
/// "2 cuts; no face followed in 40 of 300 pictures".
[[nodiscard]] std::string notes_of(const EncodingReport& report);

}  // namespace fbs::cli
