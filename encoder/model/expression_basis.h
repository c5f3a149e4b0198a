// Converts between control points and the coefficients that the stream codes (GenericHead::expression).
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <opencv2/core.hpp>

#include "bitstream/coded_state.h"

namespace fbs {

inline constexpr int kCoefficientCount = 2 * kControlCount;

/// Offsets of all control points, head units, as one row: x0, y0, x1, y1 ...
using Offsets = std::array<glm::dvec2, kControlCount>;

/// The coefficients, head units, that move the control points by `offsets`.
[[nodiscard]] std::array<double, kCoefficientCount> to_coefficients(const Offsets& offsets);

/// Converts a quadratic over the offsets to one over the coefficients.
/// @param quadratic  kCoefficientCount x kCoefficientCount, symmetric
[[nodiscard]] cv::Mat1d quadratic_of_coefficients(const cv::Mat1d& quadratic);

/// Converts rows of a matrix over the offsets, one for each other number, to the coefficients.
/// @param rows  n x kCoefficientCount
[[nodiscard]] cv::Mat1d rows_of_coefficients(const cv::Mat1d& rows);

}  // namespace fbs
