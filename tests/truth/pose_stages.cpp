// pose_stages: accuracy of the pose after each stage of the analysis, on the talker with true marks.
//
//   pose_stages [NOISE ...]
//
// Head tracker (flow and alignment with the first picture), fit to the pattern, and the encoder's choice.
// Each stage starts from the tracker's own pose, as in the encoder. Degrees and percent, mean and 95th
// percentile over three seeds; `gain` is the slope of found against true angles: 1 when depth is right.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <vector>

#include "bitstream/track.h"
#include "encoder/encoder.h"
#include "encoder/find/adapt.h"
#include "encoder/fit/picture_fit.h"
#include "encoder/plan/operating_point.h"
#include "encoder/plan/track_planner.h"
#include "encoder/track/feature_tracker.h"
#include "encoder/track/head_tracker.h"
#include "tests/unit/talker_clip.h"

namespace {

using namespace fbs;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr std::size_t kGroup = 30;

/// Errors of one stage over pictures.
struct Stage {
  const char* name;
  std::vector<double> turn{};                 ///< angle of the rotation between found and true, degrees
  std::array<double, 3> off{};                ///< sums of |pitch|, |yaw|, |roll| errors, degrees
  std::array<double, 3> product{}, square{};  ///< for the gains of pitch, yaw, roll
  double scale = 0;                           ///< sum, percent

  void take(const Pose& found, const Pose& truth) {
    const auto rotation = [](const Pose& p) {
      Pose unit = p;
      unit.log2_scale = 0;
      return PoseProjection(unit).matrix;
    };
    const glm::dmat3 a = rotation(found), b = rotation(truth);
    double trace = 0, length = 0;
    for (int c = 0; c < 3; ++c) trace += glm::dot(a[c], b[c]), length += glm::dot(b[c], b[c]);
    turn.push_back(kDegrees * std::acos(std::clamp((3 * trace / length - 1) / 2, -1.0, 1.0)));
    const std::array<double, 3> f = {found.pitch, found.yaw, found.roll},
                                t = {truth.pitch, truth.yaw, truth.roll};
    for (std::size_t k = 0; k < 3; ++k) {
      off[k] += kDegrees * std::abs(f[k] - t[k]);
      product[k] += f[k] * t[k];
      square[k] += t[k] * t[k];
    }
    scale += 100 * std::abs(std::exp2(found.log2_scale - truth.log2_scale) - 1);
  }

  void print(double noise) {
    std::ranges::sort(turn);
    const auto n = static_cast<double>(turn.size());
    double sum = 0;
    for (const double t : turn) sum += t;
    std::printf("%5.0f  %-13s %6.2f %6.2f   %6.2f %6.2f %6.2f   %6.2f %6.2f %6.2f   %6.2f\n", noise, name,
                sum / n, turn[turn.size() * 95 / 100], off[0] / n, off[1] / n, off[2] / n,
                product[0] / square[0], product[1] / square[1], product[2] / square[2], scale / n);
  }
};

/// The analysis of the encoder, recording the pose after each stage.
void follow(TalkerClip clip, std::array<Stage, 3>& stages) {
  const AdaptedHead head = *adapt_head(clip.marks(0));
  const double eye = head.pose.eye_distance_px();
  const OperatingPoint point = OperatingPoint::at(50, eye);
  Setup setup;
  setup.format = clip.format();
  setup.steps = point.steps;
  CodedState anchor{};
  const auto numbers = numbers_of(head.pose);
  for (std::size_t i = 0; i < kPoseCount; ++i)
    anchor[i] = static_cast<std::int32_t>(std::lround(numbers[i] / step_of(setup.steps, i)));
  const State seen = state_of(anchor, setup.steps);
  const WorkFrame first = WorkFrame::cut(clip[0], head.pose.shift, eye, true);
  HeadTracker tracker(head.geometry, head.pose, first);
  FeatureTracker features(head.geometry, head.pose, first);
  PictureFit fit(setup, head.geometry, {first, seen});
  const TrackPlanner planner(setup.steps, setup.parts);
  TrackRate rate;
  Fit now{pose_of(seen), {}, {}, {}};
  std::vector<PictureCost> fits;
  std::vector<Pose> truths;
  for (int i = 1; i < clip.count(); ++i) {
    const WorkFrame frame = WorkFrame::cut(clip[i], tracker.pose().shift, eye, true);
    const TrackedPose tracked = tracker.track(frame, skinned(head.geometry, now.offsets));
    features.track(frame, tracked.pose, tracker.flow());
    fit.set_picture(frame);
    now = fit.refine({tracked.pose, now.light, now.interior, features.offsets()});
    fits.push_back(fit.cost_at(now));
    truths.push_back(clip.pose(i));
    stages[0].take(tracked.pose, truths.back());
    stages[1].take(now.pose, truths.back());
    if (fits.size() < kGroup && i + 1 < clip.count()) continue;
    const MotionGroup group = planner.plan(anchor, fits, rate, point.lambda);
    const std::vector<State> chosen = states_of(group, setup.steps);
    for (std::size_t t = 0; t < chosen.size(); ++t) stages[2].take(pose_of(chosen[t]), truths[t]);
    rate.learn(group);
    anchor = last_of(group);
    fits.clear();
    truths.clear();
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<float> noises;
  for (int i = 1; i < argc; ++i) noises.push_back(std::strtof(argv[i], nullptr));
  if (noises.empty()) noises = {0, 3, 6};
  std::puts("noise  stage          mean    95 %    pitch    yaw   roll    gains of the three   scale, %");
  for (const float noise : noises) {
    std::array<Stage, 3> stages{{{.name = "head tracker"}, {.name = "fit to picture"}, {.name = "chosen"}}};
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      talker::Settings settings = talker_settings(352, 288, 150);
      settings.yaw_deg = 25;
      settings.pitch_deg = settings.roll_deg = 15;
      settings.scale = 0.2F;
      settings.noise = noise;
      settings.seed = seed;
      follow(TalkerClip(settings), stages);
    }
    for (Stage& stage : stages) stage.print(static_cast<double>(noise));
  }
  return 0;
}
