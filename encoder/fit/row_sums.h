// The sums of a patch's normal equations, by vector code for each kind of processor.
#pragma once

#include <cstddef>

namespace fbs {

inline constexpr std::size_t kRowsTogether = 4;  ///< rows whose products are added up before they join a sum
inline constexpr std::size_t kRowLanes = 8;

/// Sums products of columns over rows: out[i][j] = sum of weighted[row][i] * rows[row][j], for j >= i and up
/// to kRowLanes - 1 smaller ones. The same to the last bit on all processors that have no fused products.
/// @param rows      `count` rows of `stride` numbers
/// @param weighted  the same, each times its row's weight
/// @param count     a multiple of kRowsTogether
/// @param stride    a multiple of kRowLanes; numbers behind the columns in use are zero
/// @param out       `stride` rows of `stride` numbers
void sum_products(const float* rows, const float* weighted, std::size_t count, std::size_t stride,
                  float* out);

}  // namespace fbs
