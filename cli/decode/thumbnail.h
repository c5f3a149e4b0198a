// The picture that stands for a stream in file managers.
#pragma once

#include "cli/decode/decode_arguments.h"
#include "common/result.h"

namespace fbs::cli {

/// Writes one picture of a.input as a PNG into a.output, with a longer side of at most a.thumbnail pixels:
/// the first that shows the face from the front with open eyes, otherwise the first with a face, otherwise
/// the first. Only the beginning of the stream is read, and of a damaged one what comes before the damage. A
/// file that exists is written over, not replaced.
Result<void> write_thumbnail(const DecodeArguments& a);

}  // namespace fbs::cli
