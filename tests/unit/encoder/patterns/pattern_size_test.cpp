#include "encoder/patterns/pattern_size.h"

#include <gtest/gtest.h>

namespace fbs {
namespace {

constexpr PatternCost kFull{6000, 600, 20};

TEST(ReducedSizePays, WhereBytesFallAndErrorsHardlyRise) {
  EXPECT_TRUE(reduced_size_pays(20, 20, 1000, kFull, {2000, 200, 22}));
}

TEST(ReducedSizePays, NotWhereNothingIsSaved) {
  EXPECT_FALSE(reduced_size_pays(20, 20, 1000, kFull, kFull));
  EXPECT_FALSE(reduced_size_pays(20, 20, 1000, kFull, {6600, 660, 25}));
}

TEST(ReducedSizePays, NotWhereDetailIsLost) {
  EXPECT_FALSE(reduced_size_pays(20, 20, 1000, kFull, {4000, 400, 90}));
}

TEST(ReducedSizePays, LessWhereOtherBytesOutweighThePatterns) {
  const PatternCost reduced{3000, 300, 40};
  EXPECT_TRUE(reduced_size_pays(20, 20, 0, kFull, reduced));
  EXPECT_FALSE(reduced_size_pays(20, 20, 1e6, kFull, reduced));
}

TEST(ReducedSizePays, RatherWherePicturesDifferFromTheirBlendsAnyway) {
  const PatternCost reduced{4000, 400, 40};
  EXPECT_FALSE(reduced_size_pays(0, 20, 1000, kFull, reduced));
  EXPECT_TRUE(reduced_size_pays(200, 20, 1000, kFull, reduced));
}

TEST(ReducedSizePays, LaterPatternsCountWithTheirNumber) {
  const PatternCost reduced{6000, 200, 25};  // the first one saves nothing
  EXPECT_FALSE(reduced_size_pays(20, 2, 1000, kFull, reduced));
  EXPECT_TRUE(reduced_size_pays(20, 60, 1000, kFull, reduced));
}

}  // namespace
}  // namespace fbs
