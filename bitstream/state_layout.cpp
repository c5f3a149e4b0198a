#include "bitstream/state_layout.h"

#include <algorithm>

namespace fbs {
namespace {

constexpr int kMirrorFirst = static_cast<int>(FeatureId::kBrowRight);

constexpr int controls_in_all() {
  int sum = 0;
  for (const int count : kControlsOfFeature) sum += count;
  return sum;
}
static_assert(controls_in_all() == kControlCount);

constexpr int parameter_of(int control, int axis) {
  return kPoseCount + 2 * control + axis;
}

constexpr std::array<Part, kPartCount> make_parts() {
  std::array<Part, kPartCount> parts{};
  parts[0] = {0, kPoseCount, -1};
  int first = kPoseCount;
  for (int feature = 0; feature < kFeatureCount; ++feature) {
    const int count = 2 * kControlsOfFeature[static_cast<std::size_t>(feature)];
    // Inner lips follow the outer lips; of a pair the left follows the right; the right lower lid the upper.
    int partner = -1;
    if (feature == static_cast<int>(FeatureId::kMouthInner)) partner = feature;
    if (feature >= kMirrorFirst && (feature - kMirrorFirst) % 2 == 1) partner = feature;
    if (feature == static_cast<int>(FeatureId::kLowerLidRight)) partner = feature - 1;
    parts[static_cast<std::size_t>(feature) + 1] = {
        static_cast<std::int8_t>(first), static_cast<std::int8_t>(count), static_cast<std::int8_t>(partner)};
    first += count;
  }
  return parts;
}

constexpr std::array<Part, kPartCount> kParts = make_parts();

constexpr Neighbour neighbour(int parameter, int sign = 1) {
  return {static_cast<std::int8_t>(parameter), static_cast<std::int8_t>(sign)};
}

// The control point whose movement is likely to be like that of point `i` of `feature`.
constexpr Neighbour partner_of(int feature, int i, int axis) {
  const auto first_control = [](int f) {
    return (kParts[static_cast<std::size_t>(f) + 1].first - kPoseCount) / 2;
  };
  if (feature == static_cast<int>(FeatureId::kMouthInner)) {
    return neighbour(parameter_of(first_control(0) + (i * 10 + 4) / 8, axis));
  }
  if (feature < kMirrorFirst || (feature - kMirrorFirst) % 2 == 0) return {};
  const int count = kControlsOfFeature[static_cast<std::size_t>(feature)];
  const bool pupil = feature == static_cast<int>(FeatureId::kPupilLeft);
  // Right features run towards the nose and left ones away from it (lower lids the other way round).
  return neighbour(parameter_of(first_control(feature - 1) + count - 1 - i, axis),
                   axis == 0 && !pupil ? -1 : 1);
}

constexpr int class_of(int feature) {
  return feature < kMirrorFirst ? feature : kMirrorFirst + (feature - kMirrorFirst) / 2;
}

constexpr std::array<Parameter, kParameterCount> make_parameters() {
  std::array<Parameter, kParameterCount> all{};
  for (int i = 0; i < kPoseCount; ++i) {
    auto& p = all[static_cast<std::size_t>(i)];
    p.of_class = static_cast<std::int8_t>(i);
    if (i > 0) p.previous = neighbour(i - 1);
  }
  for (int feature = 0; feature < kFeatureCount; ++feature) {
    const Part& part = kParts[static_cast<std::size_t>(feature) + 1];
    for (int i = 0; i < part.count; ++i) {
      auto& p = all[static_cast<std::size_t>(part.first + i)];
      const int axis = i % 2;
      p.part = static_cast<std::int8_t>(feature + 1);
      p.kind = static_cast<std::int8_t>(1 + axis);
      p.of_class = static_cast<std::int8_t>(kPoseCount + 2 * class_of(feature) + axis);
      if (i >= 2) p.previous = neighbour(part.first + i - 2);
      if (axis == 1) p.across = neighbour(part.first + i - 1);
      p.partner = partner_of(feature, i / 2, axis);
    }
  }
  return all;
}

constexpr std::array<Parameter, kParameterCount> kParameters = make_parameters();

}  // namespace

FlatState flatten(const State& state) {
  FlatState flat{};
  std::copy(state.pose.begin(), state.pose.end(), flat.begin());
  for (int i = 0; i < kControlCount; ++i) {
    const auto control = static_cast<std::size_t>(i);
    flat[static_cast<std::size_t>(parameter_of(i, 0))] = state.control[control].x;
    flat[static_cast<std::size_t>(parameter_of(i, 1))] = state.control[control].y;
  }
  return flat;
}

State unflatten(const FlatState& flat) {
  State state;
  std::copy_n(flat.begin(), kPoseCount, state.pose.begin());
  for (int i = 0; i < kControlCount; ++i) {
    state.control[static_cast<std::size_t>(i)] = {flat[static_cast<std::size_t>(parameter_of(i, 0))],
                                                  flat[static_cast<std::size_t>(parameter_of(i, 1))]};
  }
  return state;
}

const std::array<Parameter, kParameterCount>& parameters() {
  return kParameters;
}
const std::array<Part, kPartCount>& parts() {
  return kParts;
}

StateLimits::StateLimits(const Setup& setup) : coded(static_cast<PartMask>(setup.features << 1 | 1)) {
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    const bool sent = (coded >> kParameters[i].part & 1) != 0;
    if (i <= kRoll) {
      most[i] = kMaxRotation / setup.steps.rotation;
    } else if (i <= kShiftY) {
      most[i] = kMaxTranslation / setup.steps.translation;
    } else if (i == kLogScale) {
      most[i] = kMaxLogScale / setup.steps.log_scale;
    } else if (sent) {
      most[i] = kMaxControl / setup.steps.control;
    }
    least[i] = i == kLogScale ? 0 : -most[i];
  }
}

bool StateLimits::hold(const FlatState& state) const {
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    if (state[i] < least[i] || state[i] > most[i]) return false;
  }
  return true;
}

}  // namespace fbs
