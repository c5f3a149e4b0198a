#include "decoder/draw/mouth_painter.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "decoder/head/head_projection.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {
namespace {

/// x along the mouth, y down from the line between its corners.
using MouthPoint = glm::vec<2, std::int64_t>;

/// Places are in 2^-12 of the mouth's width; curves have values at 65 of them.
constexpr int kWidthLog2 = 12, kStepLog2 = 6, kSteps = 1 << (kWidthLog2 - kStepLog2);
constexpr std::int64_t kMaxDown = std::int64_t{8} << kWidthLog2;

/// Narrower mouths, 1/64 luma sample, are not drawn.
constexpr std::int64_t kLeastWidth = 1 << kScreenOneLog2;

/// The frame of the mouth's corners.
class MouthFrame {
 public:
  MouthFrame(glm::ivec2 right, glm::ivec2 left) : right_(right), axis_(MouthPoint(left) - MouthPoint(right)) {
    const std::int64_t square = axis_.x * axis_.x + axis_.y * axis_.y;
    if (square < kLeastWidth * kLeastWidth) return;
    unit_ = MouthPoint(axis_.x * kUnitOne / square, axis_.y * kUnitOne / square);
  }
  [[nodiscard]] bool empty() const { return unit_ == MouthPoint(0); }
  [[nodiscard]] MouthPoint at(MouthPoint screen) const {
    const MouthPoint v = screen - right_;
    return {(unit_.x * v.x + unit_.y * v.y) >> kUnitShift,
            std::clamp((unit_.x * v.y - unit_.y * v.x) >> kUnitShift, -kMaxDown, kMaxDown)};
  }
  /// The inverse, for a box around what is drawn: not exact.
  [[nodiscard]] MouthPoint on_screen(MouthPoint p) const {
    return right_ + MouthPoint((axis_.x * p.x - axis_.y * p.y) >> kWidthLog2,
                               (axis_.y * p.x + axis_.x * p.y) >> kWidthLog2);
  }
  /// One luma sample along the mouth.
  [[nodiscard]] std::int64_t sample() const {
    return (std::int64_t{1} << (kScreenOneLog2 + kWidthLog2)) /
           std::max(std::abs(axis_.x), std::abs(axis_.y));
  }

 private:
  static constexpr int kUnitShift = 16;
  static constexpr std::int64_t kUnitOne = std::int64_t{1} << (kWidthLog2 + kUnitShift);

  MouthPoint right_, axis_;
  MouthPoint unit_{0};
};

/// Values of y at rising x, each 2^kStepLog2 apart.
using Curve = std::array<std::int32_t, kSteps + 1>;

/// A cubic through points, with the slopes of Catmull and Rom.
/// @param points  at least two; x is moved where it does not rise
Curve curve_through(std::vector<MouthPoint> points) {
  const std::size_t last = points.size() - 1;
  for (std::size_t k = 1; k < last; ++k)
    points[k].x = std::clamp<std::int64_t>(points[k].x, points[k - 1].x + 1,
                                           (1 << kWidthLog2) - static_cast<std::int64_t>(last - k));
  const auto slope = [&](std::size_t from, std::size_t to) {
    return ((points[to].y - points[from].y) << kWidthLog2) / (points[to].x - points[from].x);
  };
  std::vector<std::int64_t> slopes(last + 1, slope(0, last));
  for (std::size_t k = 1; k < last; ++k) slopes[k] = slope(k - 1, k + 1);
  if (last > 1) {
    slopes[0] = (3 * slope(0, 1) - slopes[1]) / 2;
    slopes[last] = (3 * slope(last - 1, last) - slopes[last - 1]) / 2;
  }
  Curve out;
  std::size_t k = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const std::int64_t x = i << kStepLog2;
    while (k + 1 < last && points[k + 1].x <= x) ++k;
    const MouthPoint a = points[k], b = points[k + 1];
    const std::int64_t p = ((x - a.x) << kWidthLog2) / (b.x - a.x), q = (1 << kWidthLog2) - p;
    const std::int64_t share = p * p * ((3 << kWidthLog2) - 2 * p) >> 2 * kWidthLog2;
    const std::int64_t bend =
        (slopes[k] * (p * q * q >> 2 * kWidthLog2) - slopes[k + 1] * (p * p * q >> 2 * kWidthLog2)) >>
        kWidthLog2;
    const std::int64_t y = a.y + ((b.y - a.y) * share >> kWidthLog2) + ((b.x - a.x) * bend >> kWidthLog2);
    out[i] = static_cast<std::int32_t>(std::clamp(y, -kMaxDown, kMaxDown));
  }
  return out;
}

/// Height of a curve at x, 0..2^kWidthLog2 - 1.
std::int64_t height(const Curve& curve, std::int64_t x) {
  const auto i = static_cast<std::size_t>(x >> kStepLog2);
  const std::int64_t part = x & ((1 << kStepLog2) - 1);
  return curve[i] + ((curve[i + 1] - curve[i]) * part >> kStepLog2);
}

/// The opening between the lips.
class Opening {
 public:
  Opening(const ScreenMesh& mesh, const WireFrame& head) : Opening(mesh, inner_lips(head)) {}

  /// Whether no sample is inside.
  [[nodiscard]] bool empty() const { return frame_.empty(); }

  /// A place inside.
  struct Inside {
    std::int32_t opacity;  ///< 0..256; 0: not inside
    std::int32_t ramp;     ///< 0 at the upper lip to kMouthRampEnd at the lower
  };
  [[nodiscard]] Inside at(MouthPoint screen) const {
    const MouthPoint p = frame_.at(screen);
    if (p.x < 0 || p.x >= 1 << kWidthLog2) return {0, 0};
    const std::int64_t upper = height(upper_, p.x), lower = height(lower_, p.x);
    const std::int64_t depth = std::min(p.y - upper, lower - p.y), gap = lower - upper;
    if (depth <= 0) return {0, 0};
    const std::int64_t fade = std::max(sample_, gap * kInteriorFade >> 8);
    return {
        static_cast<std::int32_t>(std::min<std::int64_t>(kInteriorOpaque, depth * kInteriorOpaque / fade)),
        static_cast<std::int32_t>((p.y - upper) * kMouthRampEnd / gap)};
  }

  /// Samples of a plane that may be inside, within `limit`.
  [[nodiscard]] SampleArea box(PlaneScale scale, const SampleArea& limit) const {
    const std::int64_t top = *std::min_element(upper_.begin(), upper_.end()),
                       bottom = *std::max_element(lower_.begin(), lower_.end()), width = 1 << kWidthLog2;
    glm::ivec2 low(INT32_MAX), high(INT32_MIN);
    for (const MouthPoint corner :
         {MouthPoint(0, top), MouthPoint(width, top), MouthPoint(0, bottom), MouthPoint(width, bottom)}) {
      const glm::ivec2 p(frame_.on_screen(corner));
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    constexpr int kInexact = 2 << kScreenOneLog2;  // on_screen()
    return samples_in_box(low - kInexact, high + kInexact, scale, limit);
  }

 private:
  Opening(const ScreenMesh& mesh, const InnerLips& lips)
      : frame_(mesh.head[lips.upper.front()], mesh.head[lips.upper.back()]) {
    if (frame_.empty()) return;
    const auto curve = [&](const std::vector<std::uint16_t>& vertices) {
      std::vector<MouthPoint> points;
      points.reserve(vertices.size());
      for (const std::uint16_t v : vertices)
        points.push_back(frame_.at(MouthPoint(mesh.head[v].x, mesh.head[v].y)));
      points.front() = MouthPoint(0);
      points.back() = MouthPoint(1 << kWidthLog2, 0);
      return curve_through(std::move(points));
    };
    upper_ = curve(lips.upper);
    lower_ = curve(lips.lower);
    sample_ = std::max<std::int64_t>(frame_.sample(), 1);
  }

  MouthFrame frame_;
  Curve upper_{}, lower_{};
  std::int64_t sample_ = 1;
};

/// Opacity of the colours, which grows with the parting of the lips since the patterns were seen: the mean
/// over the sources of the mouth.
std::int32_t blended_opacity(const Drawing& d) {
  const auto& weights = d.blend.regions[static_cast<std::size_t>(Region::kMouth)];
  std::int32_t sum = kBlendOne / 2;
  for (std::size_t s = 0; s < weights.size(); ++s)
    if (const TextureMesh* const texture = d.sources[s].texture; texture != nullptr)
      sum += weights[s] * interior_opacity(d.mesh.mouth_gap, texture->mouth_gap);
  return sum / kBlendOne;
}

}  // namespace

void draw_mouth(const Drawing& drawing, const WireFrame& head, PlaneScale scale) {
  const std::int32_t opacity = blended_opacity(drawing);
  if (opacity == 0) return;
  const Opening opening(drawing.mesh, head);
  if (opening.empty()) return;
  const auto planes = planes_of_scale(drawing.target, scale);
  const auto colours = planes_of_scale(drawing.interior, scale);
  const int bits = static_cast<int>(scale);
  const auto centre = [&](int sample) { return (std::int64_t{sample} << bits) + (1 << (bits - 1)); };
  const SampleArea box = opening.box(scale, drawing.area(scale));
  for (int y = box.y0; y < box.y1; ++y)
    for (int x = box.x0; x < box.x1; ++x) {
      const Opening::Inside at = opening.at(MouthPoint(centre(x), centre(y)));
      const std::int32_t share = (opacity * at.opacity + kInteriorOpaque / 2) / kInteriorOpaque;
      if (share == 0) continue;
      for (std::size_t k = 0; k < planes.size(); ++k) {
        std::uint8_t& sample = planes[k].row(y)[x];
        sample = with_interior(sample, colours[k], at.ramp, share);
      }
    }
}

}  // namespace fbs
