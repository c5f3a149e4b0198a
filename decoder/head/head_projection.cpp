#include "decoder/head/head_projection.h"

#include <algorithm>

#include "decoder/head/fixed_math.h"

namespace fbs {

std::int32_t clamp_screen(std::int64_t v) {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(v, -kMaxScreen, kMaxScreen));
}

HeadPose head_pose(const State& state) {
  return {state.pose[kPitch],  state.pose[kYaw],    state.pose[kRoll],
          state.pose[kShiftX], state.pose[kShiftY], state.pose[kLogScale]};
}

HeadProjection::HeadProjection(const HeadPose& pose)
    : scale(exp2_q16(pose.log_scale)), shift(pose.shift_x, pose.shift_y) {
  const std::int64_t sp = sine(pose.pitch), cp = cosine(pose.pitch);
  const std::int64_t sy = sine(pose.yaw), cy = cosine(pose.yaw);
  const std::int64_t sr = sine(pose.roll), cr = cosine(pose.roll);
  const auto q = [](std::int64_t product) { return round_shift(product, kRotationOneLog2); };
  const std::int64_t sysp = q(sy * sp), sycp = q(sy * cp);
  const auto i = [](std::int64_t v) { return static_cast<std::int32_t>(v); };
  rotation = {{{i(q(cr * cy)), i(q(cr * sysp - sr * cp)), i(q(cr * sycp + sr * sp))},
               {i(q(sr * cy)), i(q(sr * sysp + cr * cp)), i(q(sr * sycp - cr * sp))},
               {i(-sy), i(q(cy * sp)), i(q(cy * cp))}}};
}

glm::ivec3 HeadProjection::operator()(glm::ivec3 p) const {
  const auto rotated = [&](const std::array<std::int32_t, 3>& row) {
    return round_shift(std::int64_t{row[0]} * p.x + std::int64_t{row[1]} * p.y + std::int64_t{row[2]} * p.z,
                       kRotationOneLog2);
  };
  constexpr int kToScreen = kScaleOneLog2 + kHeadOneLog2 - kScreenOneLog2;
  return {clamp_screen(shift.x + round_shift(scale * rotated(rotation[0]), kToScreen)),
          clamp_screen(shift.y + round_shift(scale * rotated(rotation[1]), kToScreen)),
          static_cast<std::int32_t>(rotated(rotation[2]))};
}

}  // namespace fbs
