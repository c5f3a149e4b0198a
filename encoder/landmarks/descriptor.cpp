#include "encoder/landmarks/descriptor.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "encoder/image/bilinear.h"

namespace fbs {
namespace {

/// Root-mean-square radius of the face, as a share of the square's side.
constexpr float kFaceRadius = 0.26F;

PlaneSimilarity to_square(const Shape& shape, const Shape& mean, int side) {
  PlaneSimilarity to = PlaneSimilarity::between(shape, mean);
  const float scale = kFaceRadius * static_cast<float>(side), middle = static_cast<float>(side) / 2;
  return {to.turn * scale, to.shift * scale + std::complex<float>(middle, middle)};
}

/// The patch drawn upright into the square.
cv::Mat1f drawn_upright(const cv::Mat1b& patch, const PlaneSimilarity& to, int side) {
  const cv::Matx23f m(to.turn.real(), -to.turn.imag(), to.shift.real(), to.turn.imag(), to.turn.real(),
                      to.shift.imag());
  cv::Mat square;
  cv::warpAffine(patch, square, m, {side, side}, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return cv::Mat1f(square);
}

Histogram sample(const cv::Mat& maps, glm::vec2 at) {
  const BilinearCell<float> cell(clamped(maps, at, 1.001F));
  const float u = cell.fraction.x, v = cell.fraction.y;
  const auto *a = maps.ptr<Histogram>(cell.row) + cell.column,
             *b = maps.ptr<Histogram>(cell.row + 1) + cell.column;
  return (a[0] * (1 - u) + a[1] * u) * (1 - v) + (b[0] * (1 - u) + b[1] * u) * v;
}

}  // namespace

UprightView::UprightView(const cv::Mat1b& patch, const Shape& shape, const Shape& mean, const Look& look)
    : to_square_(to_square(shape, mean, look.side)),
      radius_(look.radius),
      maps_(orientation_maps(drawn_upright(patch, to_square_, look.side), look.sigma)) {}

void UprightView::describe(const Shape& shape, std::span<float> out) const {
  auto next = out.begin();
  for (const glm::vec2 landmark : to_square_(shape)) {
    const auto first = next;
    for (const glm::vec2 spot : kSpotDirections)
      next = std::ranges::copy(sample(maps_, landmark + spot * radius_).val, next).out;
    scale_to_unit_length({first, next});
  }
}

}  // namespace fbs
