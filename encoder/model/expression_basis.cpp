#include "encoder/model/expression_basis.h"

namespace fbs {
namespace {

/// offsets = expand^T * coefficients, part by part.
struct Block {
  int first;  ///< column of the part's first number
  cv::Mat1d expand, inverse;
};

const std::array<Block, kExpressionPartCount>& blocks() {
  static const std::array<Block, kExpressionPartCount> all = [] {
    std::array<Block, kExpressionPartCount> out;
    for (std::size_t p = 0; p < kExpressionPartCount; ++p) {
      const ExpressionPart& part = generic_head().expression[p];
      const int n = 2 * part.control_count;
      cv::Mat1d rows(n, n);
      for (int i = 0; i < n * n; ++i) rows(i / n, i % n) = part.rows[i] / static_cast<double>(kSkinningOne);
      out[p] = {2 * part.first_control, rows, cv::Mat1d(rows.inv())};
    }
    return out;
  }();
  return all;
}

}  // namespace

std::array<double, kCoefficientCount> to_coefficients(const Offsets& offsets) {
  std::array<double, kCoefficientCount> out{};
  for (const Block& b : blocks()) {
    for (int k = 0; k < b.inverse.cols; ++k) {
      double sum = 0;
      for (int c = 0; c < b.inverse.rows; ++c) {
        const glm::dvec2& o = offsets[(b.first + c) / 2];
        sum += b.inverse(c, k) * (c % 2 == 0 ? o.x : o.y);
      }
      out[b.first + k] = sum;
    }
  }
  return out;
}

cv::Mat1d rows_of_coefficients(const cv::Mat1d& rows) {
  cv::Mat1d out(rows.rows, rows.cols);
  for (const Block& b : blocks()) {
    const cv::Range columns(b.first, b.first + b.expand.cols);
    cv::Mat(cv::Mat(rows.colRange(columns)) * b.expand.t()).copyTo(out.colRange(columns));
  }
  return out;
}

cv::Mat1d quadratic_of_coefficients(const cv::Mat1d& quadratic) {
  const cv::Mat1d half = rows_of_coefficients(quadratic);
  return rows_of_coefficients(cv::Mat1d(half.t()));
}

}  // namespace fbs
