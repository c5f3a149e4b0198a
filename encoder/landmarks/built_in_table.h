// The landmark table, built in from landmarks.table.
#pragma once

#include <cstdint>
#include <span>

namespace fbs {

/// Valid for the program's lifetime.
[[nodiscard]] std::span<const std::uint8_t> built_in_landmark_table();

}  // namespace fbs
