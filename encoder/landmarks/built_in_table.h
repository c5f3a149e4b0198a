// The table that landmarks.table becomes at build time.
#pragma once

#include <cstdint>
#include <span>

namespace fbs {

/// Valid as long as the program runs.
[[nodiscard]] std::span<const std::uint8_t> built_in_landmark_table();

}  // namespace fbs
