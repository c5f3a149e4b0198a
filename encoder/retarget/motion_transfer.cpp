#include "encoder/retarget/motion_transfer.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <span>

#include "encoder/model/fit.h"

namespace fbs {
namespace {

/// Limits of the ratio of a feature's size between two people; beyond, its marks are wrong.
constexpr double kMinScale = 0.5, kMaxScale = 2;
/// Touching lips are measured apart, by 0 to 8 % of the eye distance in seven clips, depending on the person.
/// The mouth is assumed shut in at least this share of the pictures, unless it is wide open in all.
constexpr double kShutShare = 0.05;
constexpr double kMaxShutGap = 0.06 * kUnitsPerEyeDistance;
constexpr double kShutMargin = 0.015 * kUnitsPerEyeDistance;
constexpr std::array<std::array<std::size_t, 2>, 3> kLipPairs{
    {{61, 67}, {62, 66}, {63, 65}}};  // upper, lower

/// Distances between the inner lips at the pairs of landmarks, head units.
using LipGaps = std::array<double, 3>;

glm::dvec2 point(const Geometry& geometry, int landmark) {
  return glm::dvec2(
      geometry.positions[geometry.wire_frame().vertex_of_landmark(static_cast<std::size_t>(landmark))]);
}

glm::dvec2 middle(const Geometry& geometry, int first, int last) {
  glm::dvec2 sum{0, 0};
  for (int k = first; k <= last; ++k) sum += point(geometry, k);
  return sum / static_cast<double>(last - first + 1);
}

/// Width and height of each feature, by which its motion is scaled.
std::array<glm::dvec2, kFeatureCount> sizes_of(const Geometry& g) {
  const auto width = [&](int a, int b) { return std::abs(point(g, b).x - point(g, a).x); };
  const glm::dvec2 mouth{width(48, 54), point(g, 8).y - middle(g, 48, 59).y};
  const auto brow = [&](int first, int eye) {
    return glm::dvec2(width(first, first + 4), middle(g, eye, eye + 5).y - middle(g, first, first + 4).y);
  };
  const auto eye = [&](int first) {
    return glm::dvec2(width(first, first + 3),
                      middle(g, first + 4, first + 5).y - middle(g, first + 1, first + 2).y);
  };
  const glm::dvec2 right = eye(36), left = eye(42);
  return {mouth, mouth, brow(17, 36), brow(22, 42), right, left, right, left, right, left};
}

double ratio(double shown, double moves) {
  return shown > 0 && moves > 0 ? std::clamp(shown / moves, kMinScale, kMaxScale) : 1.0;
}

/// How far down offsets of control points move a landmark's vertex, head units.
double moved_down(const WireFrame& head, std::size_t landmark, const Offsets& offsets) {
  double sum = 0;
  for (const SkinningWeight& s : head.skinning_of(head.vertex_of_landmark(landmark)))
    sum += s.weight * offsets[s.control].y;
  return sum / kSkinningOne;
}

LipGaps gaps_of(const Geometry& geometry, const Offsets& offsets) {
  LipGaps out{};
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto [upper, lower] = kLipPairs[i];
    const auto y = [&, &head = geometry.wire_frame()](std::size_t landmark) {
      return geometry.positions[head.vertex_of_landmark(landmark)].y + moved_down(head, landmark, offsets);
    };
    out[i] = y(lower) - y(upper);
  }
  return out;
}

double mean_of(const LipGaps& gaps) {
  return (gaps[0] + gaps[1] + gaps[2]) / 3;
}

/// Moves the control points of the inner lips down, and the outer lips with them: both curves run around the
/// mouth from its right corner.
/// @param down  for each control point of the inner lips, head units
void move_lips(std::span<const double> down, Offsets& offsets) {
  const Feature &inner = feature(FeatureId::kMouthInner), &outer = feature(FeatureId::kMouthOuter);
  for (std::size_t c = 0; c < down.size(); ++c) offsets[inner.first_control + c].y += down[c];
  for (int c = 0; c < outer.control_count; ++c) {
    const double s = static_cast<double>(c) * inner.control_count / outer.control_count;
    const auto before = static_cast<std::size_t>(s);
    const double part = s - static_cast<double>(before);
    offsets[outer.first_control + c].y += (1 - part) * down[before] + part * down[(before + 1) % down.size()];
  }
}

constexpr int kLipControls = 8;  ///< of the inner lips
using GapSlopes = std::array<glm::dvec3, kLipControls>;

/// Effect of each argument of move_lips() on the gaps.
GapSlopes gap_slopes(const WireFrame& head) {
  GapSlopes out;
  for (std::size_t c = 0; c < out.size(); ++c) {
    std::array<double, kLipControls> down{};
    down[c] = 1;
    Offsets offsets{};
    move_lips(down, offsets);
    for (int i = 0; i < 3; ++i)
      out[c][i] = moved_down(head, kLipPairs[i][1], offsets) - moved_down(head, kLipPairs[i][0], offsets);
  }
  return out;
}

/// Moves the lips as little as possible to change the gaps by `change`.
void add_to_gaps(const WireFrame& head, const LipGaps& change, Offsets& offsets) {
  const GapSlopes slopes = gap_slopes(head);
  glm::dmat3 squares(0.0);
  for (const glm::dvec3& slope : slopes) squares += glm::outerProduct(slope, slope);
  const glm::dvec3 pull = glm::inverse(squares) * glm::dvec3(change[0], change[1], change[2]);
  std::array<double, kLipControls> down{};
  std::ranges::transform(slopes, down.begin(), [&](glm::dvec3 slope) { return glm::dot(slope, pull); });
  move_lips(down, offsets);
}

/// The largest mean gap of a mouth assumed to be shut.
double shut_gap(const MotionRecord& motion) {
  std::vector<double> seen;
  for (const MotionRecord::Entry& picture : motion.pictures)
    seen.push_back(mean_of(gaps_of(motion.geometries[picture.geometry], fit_of(picture.state).offsets)));
  if (seen.empty()) return kShutMargin;
  const auto place =
      seen.begin() + static_cast<std::ptrdiff_t>(kShutShare * static_cast<double>(seen.size()));
  std::nth_element(seen.begin(), place, seen.end());
  return std::clamp(*place, 0.0, kMaxShutGap) + kShutMargin;
}

/// The real share of the gaps: none up to a mean of `shut`, all from twice that on.
double real_share(double mean, double shut) {
  return mean <= shut ? 0 : std::min(2 * (mean - shut) / mean, 1.0);
}

}  // namespace

StateNumbers numbers_of(const State& state) {
  StateNumbers out{};
  auto* to = out.begin();
  to = std::ranges::copy(state.pose, to).out;
  to = std::ranges::copy(state.light, to).out;
  to = std::ranges::copy(state.interior, to).out;
  to = std::ranges::copy(state.body, to).out;
  to = std::ranges::copy(state.ground, to).out;
  std::ranges::copy(to_coefficients(fit_of(state).offsets), to);
  return out;
}

MotionTransfer::MotionTransfer(const MotionRecord& motion, const FaceStream& face)
    : motion_(motion),
      face_(face),
      shut_(shut_gap(motion)),
      ratio_(std::exp2((face.rest.pose[kLogScale] - motion.rest.pose[kLogScale]) / 4096.0)) {
  const auto shown = sizes_of(face.geometry);
  for (const Geometry& geometry : motion.geometries) {
    const auto moves = sizes_of(geometry);
    auto& scale = scales_.emplace_back();
    for (std::size_t f = 0; f < kFeatureCount; ++f)
      scale[f] = {ratio(shown[f].x, moves[f].x), ratio(shown[f].y, moves[f].y)};
    lip_scales_.push_back(scale[static_cast<std::size_t>(FeatureId::kMouthInner)].y);
  }
}

Offsets MotionTransfer::scaled(const State& state, std::size_t geometry) const {
  Offsets out = fit_of(state).offsets;
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    const Feature& feature = generic_head().features[f];
    for (int c = 0; c < feature.control_count; ++c) out[feature.first_control + c] *= scales_[geometry][f];
  }
  return out;
}

void MotionTransfer::match_gaps(const MotionRecord::Entry& picture, Offsets& offsets) const {
  const LipGaps moves = gaps_of(motion_.geometries[picture.geometry], fit_of(picture.state).offsets);
  const LipGaps now = gaps_of(face_.geometry, offsets);
  const double share = lip_scales_[picture.geometry] * real_share(mean_of(moves), shut_);
  LipGaps change{};
  for (std::size_t i = 0; i < change.size(); ++i) change[i] = share * std::max(moves[i], 0.0) - now[i];
  add_to_gaps(face_.geometry.wire_frame(), change, offsets);
}

StateNumbers MotionTransfer::operator()(const MotionRecord::Entry& picture) const {
  const State& moves = picture.state;
  Offsets offsets = scaled(moves, picture.geometry);
  match_gaps(picture, offsets);
  StateNumbers out = numbers_of(face_.rest);
  for (const int angle : {kPitch, kYaw, kRoll, kLogScale})
    out[angle] += moves.pose[angle] - motion_.rest.pose[angle];
  for (const int axis : {0, 1}) {
    const int shift = kShiftX + axis;
    out[shift] += ratio_ * (moves.pose[shift] - motion_.rest.pose[shift] - moves.ground[axis]);
    out[first_of(PartId::kBody) + axis] = ratio_ * (moves.body[axis] - moves.ground[axis]);
  }
  for (const int turn : {kSimilarityScale, kSimilarityRotation})
    out[first_of(PartId::kBody) + turn] = ratio_ * moves.body[turn];
  std::ranges::copy(face_.interior, out.begin() + first_of(PartId::kMouthInterior));
  std::ranges::copy(to_coefficients(offsets), out.begin() + kFirstCoefficient);
  return out;
}

}  // namespace fbs
