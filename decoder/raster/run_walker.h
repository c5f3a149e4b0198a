// The runs of a triangle from row to row, without a division for each. SPEC 10.6. Integers only.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "decoder/raster/row_runs.h"

namespace fbs {

/// Same result as covered_run().
class RunWalker {
 public:
  /// @param triangle  faces the viewer
  /// @param row       the first
  RunWalker(const TriangleSetup& triangle, int row, const SampleArea& area) : area_(area) {
    for (std::size_t k = 0; k < borders_.size(); ++k) borders_[k] = Border(triangle.edges()[k], row);
  }

  /// The run of the current row; then advances to the next row.
  [[nodiscard]] RowRun next() {
    std::int64_t first = area_.x0, last = area_.x1 - 1;
    for (Border& b : borders_) {
      if (b.side > 0)
        first = std::max(first, -b.quotient);
      else if (b.side < 0)
        last = std::min(last, b.quotient);
      else if (b.quotient < 0)
        last = first - 1;
      b.step();
    }
    if (first > last) return {0, -1};
    return {static_cast<int>(first), static_cast<int>(last)};
  }

 private:
  /// An edge: where it crosses the row, as quotient and remainder.
  struct Border {
    int side = 0;  ///< sign of Edge::a
    std::int64_t quotient = 0, remainder = 0, divisor = 1;
    std::int64_t quotient_step = 0, remainder_step = 0;

    Border() = default;
    Border(const Edge& e, int row)
        : side(e.a > 0   ? 1
               : e.a < 0 ? -1
                         : 0),
          divisor(e.a == 0 ? 1 : std::abs(e.a)) {
      const std::int64_t at_zero = e.b * row + e.c;
      quotient = floor_div(at_zero, divisor);
      remainder = at_zero - quotient * divisor;
      quotient_step = floor_div(e.b, divisor);
      remainder_step = e.b - quotient_step * divisor;
    }
    void step() {
      quotient += quotient_step;
      remainder += remainder_step;
      const bool carry = remainder >= divisor;
      quotient += carry ? 1 : 0;
      remainder -= carry ? divisor : 0;
    }
  };

  SampleArea area_;
  std::array<Border, 3> borders_;
};

}  // namespace fbs
