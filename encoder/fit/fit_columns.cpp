#include "encoder/fit/fit_columns.h"

namespace fbs {

FitColumns::FitColumns(PartMask parts) {
  of_.fill(-1);
  for (std::size_t p = 0; p < kExpressionPartCount; ++p) {
    if (!has_part(parts, kFirstExpressionPart + p)) continue;
    const ExpressionPart& part = generic_head().expression[p];
    for (int c = 0; c < part.control_count; ++c) {
      of_[part.first_control + c] = count_;
      count_ += 2;
    }
  }
}

std::vector<int> FitColumns::numbers() const {
  std::vector<int> out(static_cast<std::size_t>(count_));
  for (int i = 0; i < kFitOffsets; ++i) out[i] = i;
  for (int c = 0; c < kControlCount; ++c)
    for (int axis = 0; axis < 2; ++axis)
      if (const int column = of_[c]; column >= 0) out[column + axis] = kFitOffsets + 2 * c + axis;
  return out;
}

}  // namespace fbs
