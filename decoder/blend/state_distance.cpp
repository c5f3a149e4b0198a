#include "decoder/blend/state_distance.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>

namespace fbs {
namespace {

/// What counts as one for a region; 0: does not count.
struct Metric {
  std::int32_t turn, roll;                   ///< 2^-16 of a rotation
  std::int32_t body, ground;                 ///< 1/64 pixel
  std::int32_t mouth, brows, lids_and_gaze;  ///< head units
  std::int32_t time;                         ///< weight of the squared distance in time, 1/256
};

// Found on five clips by the error of the blend against the source (design.md section 7).
constexpr std::array<Metric, kRegionCount> kMetric = {{
    {200, 400, 0, 0, 50, 0, 0, 128},   // mouth
    {200, 400, 0, 0, 0, 0, 150, 128},  // right eye
    {200, 400, 0, 0, 0, 0, 150, 128},  // left eye
    {200, 400, 0, 0, 150, 150, 0, 128},
    {200, 400, 0, 0, 0, 0, 0, 128},  // hair
    {400, 800, 25, 0, 0, 0, 0, 128},
    {0, 0, 0, 25, 0, 0, 0, 256},
}};

constexpr std::int64_t kMaxDifference = 1 << 24;

/// Square of a difference in units of `one`, 2^-16.
std::int64_t squared(std::int64_t difference, std::int32_t one) {
  if (one == 0) return 0;
  const std::int64_t d = std::min((std::abs(difference) << 8) / one, kMaxDifference);
  return d * d;
}

/// Controls that a region may look at, in the order of the stream.
struct ControlRange {
  FeatureId first, last;
};
constexpr ControlRange kMouthControls{FeatureId::kMouthOuter, FeatureId::kMouthInner},
    kBrowControls{FeatureId::kBrowRight, FeatureId::kBrowLeft};
constexpr std::array<FeatureId, 3> kRightEye = {FeatureId::kUpperLidRight, FeatureId::kLowerLidRight,
                                                FeatureId::kPupilRight};
constexpr std::array<FeatureId, 3> kLeftEye = {FeatureId::kUpperLidLeft, FeatureId::kLowerLidLeft,
                                               FeatureId::kPupilLeft};

std::int64_t control_distance(FeatureId id, const State& a, const State& b, std::int32_t one) {
  if (one == 0) return 0;
  const Feature& f = feature(id);
  std::int64_t sum = 0;
  for (std::size_t c = f.first_control; c < std::size_t{f.first_control} + f.control_count; ++c)
    sum += squared(a.control[c].x - b.control[c].x, one) + squared(a.control[c].y - b.control[c].y, one);
  return sum;
}

std::int64_t control_distance(const ControlRange& range, const State& a, const State& b, std::int32_t one) {
  std::int64_t sum = 0;
  for (int id = static_cast<int>(range.first); id <= static_cast<int>(range.last); ++id)
    sum += control_distance(static_cast<FeatureId>(id), a, b, one);
  return sum;
}

std::int64_t similarity_distance(const std::array<std::int32_t, kSimilarityCount>& a,
                                 const std::array<std::int32_t, kSimilarityCount>& b, std::int32_t one) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < kSimilarityCount; ++i) sum += squared(a[i] - b[i], one);
  return sum;
}

}  // namespace

std::int64_t state_distance(Region region, const State& a, const State& b, std::int32_t spacing) {
  const Metric& m = kMetric[static_cast<std::size_t>(region)];
  std::int64_t sum = squared(a.pose[kPitch] - b.pose[kPitch], m.turn) +
                     squared(a.pose[kYaw] - b.pose[kYaw], m.turn) +
                     squared(a.pose[kRoll] - b.pose[kRoll], m.roll);
  sum += similarity_distance(a.body, b.body, m.body) + similarity_distance(a.ground, b.ground, m.ground);
  sum += control_distance(kMouthControls, a, b, m.mouth) + control_distance(kBrowControls, a, b, m.brows);
  if (region == Region::kRightEye || region == Region::kLeftEye)
    for (const FeatureId id : region == Region::kRightEye ? kRightEye : kLeftEye)
      sum += control_distance(id, a, b, m.lids_and_gaze);
  return sum + (m.time * squared(std::int64_t{a.picture} - b.picture, spacing) >> 8);
}

}  // namespace fbs
