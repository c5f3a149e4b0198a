// Tables with a row for each node and a place in it for each source: kernels process eight sources at once.
#pragma once

#include <cstddef>

namespace fbs {

inline constexpr std::size_t kRowStep =
    8;  ///< row size is a multiple of this; places without a source are zero

[[nodiscard]] constexpr std::size_t row_size(std::size_t sources) {
  return (sources + kRowStep - 1) / kRowStep * kRowStep;
}

}  // namespace fbs
