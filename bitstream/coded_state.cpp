#include "bitstream/coded_state.h"

#include <algorithm>

namespace fbs {
namespace {

/// Larger than the limit of the control points, which are clamped.
constexpr std::int32_t kMaxCoefficient = 8 * kMaxControl;

std::int32_t limit_of(std::size_t i) {
  switch (static_cast<PartId>(kPartOf[i])) {
    case PartId::kPose:
      return i <= kRoll ? kMaxRotation : i <= kShiftY ? kMaxTranslation : kMaxLogScale;
    case PartId::kLight:
    case PartId::kMouthInterior:
      return kMaxLight;
    case PartId::kBody:
    case PartId::kGround:
      return kMaxTranslation;
    default:
      return kMaxCoefficient;
  }
}

}  // namespace

std::int32_t step_of(const QuantiserSteps& steps, std::size_t parameter) {
  switch (static_cast<PartId>(kPartOf[parameter])) {
    case PartId::kPose:
      return parameter <= kRoll ? steps.rotation : parameter <= kShiftY ? steps.translation : steps.log_scale;
    case PartId::kLight:
    case PartId::kMouthInterior:
      return steps.light;
    case PartId::kBody:
    case PartId::kGround:
      return steps.translation;
    default:
      return steps.control;
  }
}

State state_of_values(const CodedState& values) {
  State state;
  auto from = values.begin();
  const auto take = [&from](auto& numbers) {
    std::copy_n(from, numbers.size(), numbers.begin());
    from += numbers.size();
  };
  take(state.pose);
  take(state.light);
  take(state.interior);
  take(state.body);
  take(state.ground);
  for (const ExpressionPart& part : generic_head().expression) {
    const std::size_t n = 2 * part.control_count;
    std::array<std::int64_t, kMaxPartSize> sum{};
    for (std::size_t k = 0; k < n; ++k) {
      const std::int64_t coefficient = from[k];
      if (coefficient == 0) continue;
      for (std::size_t c = 0; c < n; ++c) sum[c] += coefficient * part.rows[k * n + c];
    }
    const auto rounded = [&](std::size_t c) {
      const std::int64_t nearest = (sum[c] + kSkinningOne / 2) >> 12;
      return static_cast<std::int32_t>(std::clamp<std::int64_t>(nearest, -kMaxControl, kMaxControl));
    };
    static_assert(kSkinningOne == 1 << 12);
    for (std::size_t c = 0; c < n; c += 2)
      state.control[part.first_control + c / 2] = {rounded(c), rounded(c + 1)};
    from += n;
  }
  return state;
}

State state_of(const CodedState& coded, const QuantiserSteps& steps) {
  CodedState values;
  for (std::size_t i = 0; i < kParameterCount; ++i) values[i] = coded[i] * step_of(steps, i);
  return state_of_values(values);
}

CodedLimits::CodedLimits(const QuantiserSteps& steps, PartMask sent_parts) : parts(sent_parts) {
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    if (!has_part(parts, kPartOf[i])) continue;
    max[i] = limit_of(i) / step_of(steps, i);
    min[i] = i == kLogScale ? 0 : -max[i];
  }
}

bool CodedLimits::hold(const CodedState& state) const {
  for (std::size_t i = 0; i < kParameterCount; ++i)
    if (!hold(i, state[i])) return false;
  return true;
}

}  // namespace fbs
