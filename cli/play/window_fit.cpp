#include "cli/play/window_fit.h"

#include <algorithm>
#include <cmath>

namespace fbs::cli {
namespace {

constexpr double kMostAspect = 8;

Size scaled(Size size, double factor) {
  return {std::max(1, static_cast<int>(std::lround(size.width * factor))),
          std::max(1, static_cast<int>(std::lround(size.height * factor)))};
}

double factor_into(Size image, Size room) {
  return std::min(static_cast<double>(room.width) / image.width,
                  static_cast<double>(room.height) / image.height);
}

}  // namespace

Size square_pixels(Size image, Rational aspect) {
  if (aspect.num == 0 || aspect.den == 0) return image;
  const double wide = static_cast<double>(aspect.num) / aspect.den;
  if (wide > kMostAspect || wide < 1 / kMostAspect) return image;
  if (wide >= 1) return {static_cast<int>(std::lround(image.width * wide)), image.height};
  return {image.width, static_cast<int>(std::lround(image.height / wide))};
}

Size shrunk_to(Size image, Size room) {
  const double factor = factor_into(image, room);
  if (factor >= 1) return image;
  const Size out = scaled(image, factor);
  return {std::min(out.width, room.width), std::min(out.height, room.height)};
}

Box letterbox(Size image, Size window) {
  const Size size = scaled(image, factor_into(image, window));
  return {(window.width - size.width) / 2, (window.height - size.height) / 2, size.width, size.height};
}

double place_on_bar(int x, int y, Size window) {
  if (y < window.height - kBarClickHeight) return -1;
  return std::clamp((x + 0.5) / window.width, 0.0, 1.0);
}

}  // namespace fbs::cli
