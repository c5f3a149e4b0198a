// What the program prints has to arrive: a full disk is noticed when it is written out.
#pragma once

#include "common/result.h"

namespace fbs::cli {

/// Writes out what has been printed.
/// @return kIo when it, or anything printed earlier, could not be written
[[nodiscard]] Result<void> flush_standard_output();

}  // namespace fbs::cli
