#include "encoder/model/expression_basis.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/toy_scene.h"

namespace fbs {
namespace {

using Coefficients = std::array<double, kCoefficientCount>;

Offsets random_offsets(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> within(-reach, reach);
  Offsets out;
  for (glm::dvec2& o : out) o = {within(random), within(random)};
  return out;
}

/// What the decoder makes of the coefficients, in doubles.
Offsets moved_by(const Coefficients& coefficients) {
  Offsets out{};
  std::size_t first = 0;
  for (const ExpressionPart& part : generic_head().expression) {
    const auto n = static_cast<std::size_t>(2 * part.control_count);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t c = 0; c < n; ++c)
        out[part.first_control + c / 2][static_cast<int>(c % 2)] +=
            coefficients[first + k] * part.rows[k * n + c] / kSkinningOne;
    first += n;
  }
  return out;
}

cv::Mat1d column_of(const Offsets& offsets) {
  cv::Mat1d out(kCoefficientCount, 1);
  for (int i = 0; i < kCoefficientCount; ++i) out(i) = offsets[i / 2][i % 2];
  return out;
}

cv::Mat1d column_of(const Coefficients& coefficients) {
  cv::Mat1d out(kCoefficientCount, 1);
  std::copy(coefficients.begin(), coefficients.end(), out.begin());
  return out;
}

cv::Mat1d random_matrix(std::mt19937& random, int rows) {
  std::uniform_real_distribution<double> within(-1, 1);
  cv::Mat1d out(rows, kCoefficientCount);
  for (double& v : out) v = within(random);
  return out;
}

TEST(ExpressionBasis, CoefficientsMoveTheControlPointsByTheOffsets) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    const Offsets wanted = random_offsets(random, 800), got = moved_by(to_coefficients(wanted));
    for (std::size_t c = 0; c < kControlCount; ++c) {
      ASSERT_NEAR(got[c].x, wanted[c].x, 1e-6) << c;
      ASSERT_NEAR(got[c].y, wanted[c].y, 1e-6) << c;
    }
  }
}

// Whatever the face does can be said: each coordinate of each control point alone.
TEST(ExpressionBasis, IsComplete) {
  for (std::size_t c = 0; c < kControlCount; ++c) {
    for (int axis = 0; axis < 2; ++axis) {
      Offsets wanted{};
      wanted[c][axis] = 500;
      const auto coefficients = to_coefficients(wanted);
      CodedState values{};
      for (std::size_t k = 0; k < kCoefficientCount; ++k) {
        EXPECT_LE(std::abs(coefficients[k]), 8 * kMaxControl) << "can be coded";
        values[kFirstCoefficient + k] = static_cast<std::int32_t>(std::lround(coefficients[k]));
      }
      const State state = state_of_values(values);
      for (std::size_t d = 0; d < kControlCount; ++d) {
        EXPECT_NEAR(state.control[d].x, wanted[d].x, 4) << c << ' ' << d;  // half a unit of each coefficient
        EXPECT_NEAR(state.control[d].y, wanted[d].y, 4) << c << ' ' << d;
      }
    }
  }
}

TEST(ExpressionBasis, RestHasNoCoefficients) {
  for (const double c : to_coefficients(Offsets{})) EXPECT_EQ(c, 0);
}

TEST(ExpressionBasis, FormIsTheSameInEitherBasis) {
  std::mt19937 random(2);
  const cv::Mat1d root = random_matrix(random, kCoefficientCount);
  const cv::Mat1d form = root.t() * root, changed = quadratic_of_coefficients(form);
  EXPECT_LT(cv::norm(changed - changed.t()), 1e-9 * cv::norm(changed)) << "symmetric";
  for (int i = 0; i < 20; ++i) {
    const Offsets offsets = random_offsets(random, 500);
    const cv::Mat1d o = column_of(offsets), c = column_of(to_coefficients(offsets));
    const double expected = cv::Mat1d(o.t() * form * o)(0);
    EXPECT_NEAR(cv::Mat1d(c.t() * changed * c)(0) / expected, 1, 1e-9);
  }
}

TEST(ExpressionBasis, RowsAreTheSameInEitherBasis) {
  std::mt19937 random(3);
  const cv::Mat1d rows = random_matrix(random, 10), changed = rows_of_coefficients(rows);
  for (int i = 0; i < 20; ++i) {
    const Offsets offsets = random_offsets(random, 500);
    const cv::Mat1d expected = rows * column_of(offsets), got = changed * column_of(to_coefficients(offsets));
    EXPECT_LT(cv::norm(got - expected), 1e-9 * cv::norm(expected));
  }
}

}  // namespace
}  // namespace fbs
