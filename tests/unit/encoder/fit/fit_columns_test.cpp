#include "encoder/fit/fit_columns.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace fbs {
namespace {

TEST(FitColumns, OfAllPartsAreTheNumbersOfTheFit) {
  const FitColumns columns(kAllParts);
  std::vector<int> all(kFitNumbers);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(columns.count(), kFitNumbers);
  EXPECT_EQ(columns.numbers(), all);
}

TEST(FitColumns, LeaveOutPartsThatAreNotSent) {
  const FitColumns columns(static_cast<PartMask>(mask_of(PartId::kPose) | mask_of(PartId::kBrows)));
  const ExpressionPart& brows = generic_head().expression[1];
  ASSERT_EQ(columns.count(), kFitOffsets + 2 * brows.control_count);
  const std::vector<int> numbers = columns.numbers();
  EXPECT_EQ(std::set<int>(numbers.begin(), numbers.end()).size(), numbers.size()) << "each its own";
  for (std::size_t c = 0; c < kControlCount; ++c) {
    const bool sent =
        c >= brows.first_control && c < static_cast<std::size_t>(brows.first_control) + brows.control_count;
    ASSERT_EQ(columns.has(c), sent) << c;
    if (sent) {
      EXPECT_EQ(numbers[columns.of(c)], kFitOffsets + 2 * static_cast<int>(c));
      EXPECT_EQ(numbers[columns.of(c) + 1], kFitOffsets + 2 * static_cast<int>(c) + 1);
    }
  }
}

}  // namespace
}  // namespace fbs
