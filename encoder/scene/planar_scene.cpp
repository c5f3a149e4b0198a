#include "encoder/scene/planar_scene.h"

#include <algorithm>
#include <utility>

#include "bitstream/payload/setup_payload.h"
#include "encoder/model/coded_numbers.h"
#include "encoder/segment/pass_settings.h"
#include "encoder/surround/map_grid.h"

namespace fbs {
namespace {

/// Quality and lambda of the motion are defined for a face: the eye distance assumed, as a share of the long
/// side.
constexpr double kEyeDistance = 1.0 / 11;

/// Step of the plane's motion, pixels: fine enough not to blur.
constexpr double kStepPx = 0.125;

SceneGeometry geometry_of(const Setup& setup, const Geometry& head, const State& rest) {
  return {setup, head, uniform_map({1, 1}, {}), rest};
}

}  // namespace

Result<std::unique_ptr<SceneEncoder>> PlanarScene::begin(const VideoFormat& format,
                                                         const EncoderSettings& settings,
                                                         const StreamPosition& before) {
  auto plane = PicturePlane::create(format);
  if (!plane) return fail(plane.error());
  Setup setup;
  setup.before = before;
  setup.format = format;
  setup.parts = mask_of(PartId::kPose);
  const double eye = kEyeDistance * std::max(format.width, format.height);
  const RateTarget target = motion_target(settings, eye);
  const RatePlan rate{OperatingPoint::at(target.quality, eye), target.motion_kbps};
  setup.steps = plane->steps(kStepPx);
  return std::unique_ptr<SceneEncoder>(new PlanarScene(setup, settings, rate, std::move(*plane)));
}

PlanarScene::PlanarScene(const Setup& setup, const EncoderSettings& settings, const RatePlan& rate,
                         PicturePlane plane)
    : ledger_(
          setup, CodedState{}, rate, settings,
          pattern_stage(planar_pass_settings(settings, rate.point), settings, setup.format, CodedState{})),
      plane_(std::move(plane)) {
  scene_.setup = setup;
  scene_.setup.patterns = ledger_.patterns()->slots();
}

Result<void> PlanarScene::push(const Picture& picture, const PictureTime& when) {
  end_picture(when.begin);
  if (ledger_.scene_ended()) begin_again();
  GlobalMotion::Observation seen = global_.observe(picture);
  if (!plane_.covers(seen.since_first)) {
    if (auto ended = finish(); !ended) return ended;
    begin_again();
    seen = global_.observe(picture);
  }
  observed_.push_back({plane_.pose(seen.since_first), PicturePlane::quadratic(seen)});
  const double kept = ledger_.live() ? 1 - 1 / std::max(1.0, fps_of(scene_.setup.format)) : 1;
  moved_ = kept * moved_ + seen.moved;
  still_ = kept * still_ + seen.still;
  if (auto added = ledger_.add(picture, when); !added) return added;
  return ledger_.group_ends() ? end_group() : Result<void>{};
}

StreamPosition PlanarScene::end_picture(std::optional<std::uint64_t> time) {
  if (time) ledger_.end_picture(*time);
  return ledger_.position();
}

void PlanarScene::cut() {
  global_.cut();
  ledger_.patterns()->cut();
}

void PlanarScene::begin_again() {
  ledger_.begin_again(scene_.setup);
  global_ = {};
}

Result<void> PlanarScene::begin_motion() {
  moving_ = moves();
  // A resting plane need not be sent: without a geometry the decoder shows the same.
  const auto numbers = numbers_of(plane_.rest());
  const CodedState rest = moving_ ? coded_state(numbers, scene_.setup) : CodedState{};
  const State rest_state = state_of(rest, scene_.setup.steps);
  scene_.geometry.emplace(geometry_of(scene_.setup, moving_ ? plane_.geometry() : no_plane(), rest_state));
  scene_.patterns.clear();
  scene_.patterns.push_back(make_pattern({}, rest_state, scene_.geometry));
  ledger_.begin_motion(scene_.setup, rest);
  auto setup = encode_setup(scene_.setup);
  if (!setup) return fail(setup.error());
  ledger_.packets().start(
      {std::move(*setup), moving_ ? plane_.payload() : std::vector<std::uint8_t>{}, {}, {}});
  return {};
}

Result<void> PlanarScene::end_group() {
  if (ledger_.in_group()) groups_.push_back(ledger_.end_group());
  if (!ledger_.segment_ends()) return {};
  return end_segment(ledger_.scene_ends());
}

Result<void> PlanarScene::add_motion() {
  auto next = observed_.begin();
  for (const std::vector<std::uint32_t>& durations : groups_) {
    std::vector<PictureCost> costs(durations.size());
    for (PictureCost& cost : costs) {
      if (!moving_) {
        next->pose = pose_of(state_of({}, scene_.setup.steps));
        next->quadratic = {};
      }
      const auto numbers = numbers_of(next->pose);
      std::copy(numbers.begin(), numbers.end(), cost.fit.begin());
      cost.layers.push_back({CostLayer::kHead, 0, 0, cv::Mat1d(kParameterCount, kParameterCount, 0.0)});
      cv::Mat(next++->quadratic).copyTo(cost.layers.back().quadratic(cv::Rect(0, 0, kPoseCount, kPoseCount)));
    }
    if (auto planned = ledger_.plan(costs, durations); !planned) return planned;
  }
  return {};
}

Result<void> PlanarScene::end_segment(bool last) {
  if (groups_.empty()) return {};
  if (!ledger_.packets().started())
    if (auto begun = begin_motion(); !begun) return begun;
  if (auto added = add_motion(); !added) return added;
  if (auto ended = ledger_.end_segment(scene_, last, {}); !ended) return ended;
  observed_.clear();
  groups_.clear();
  const bool begins_to_move = ledger_.live() && !moving_ && moves();
  if (!ledger_.live()) moved_ = still_ = 0;
  if (begins_to_move) ledger_.end_scene();
  return {};
}

Result<void> PlanarScene::finish() {
  if (ledger_.in_group()) groups_.push_back(ledger_.end_group());
  return end_segment(true);
}

}  // namespace fbs
