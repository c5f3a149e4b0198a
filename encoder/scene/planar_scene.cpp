#include "encoder/scene/planar_scene.h"

#include <algorithm>
#include <utility>

#include "bitstream/payload/setup_payload.h"
#include "encoder/model/coded_numbers.h"
#include "encoder/segment/pass_settings.h"
#include "encoder/surround/map_grid.h"

namespace fbs {
namespace {

/// Quality of the motion, and what a bit is worth, are defined relative to a face: one of this share of the
/// long side.
constexpr double kEyeDistance = 1.0 / 11;

/// Of the plane's motion, pixels: fine enough not to blur.
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
    : timing_(setup.format, settings),
      rate_(rate),
      plane_(std::move(plane)),
      key_interval_(key_interval_of(settings, setup.format)),
      motion_(setup, CodedState{}, rate, timing_.nominal_duration),
      patterns_(planar_patterns(settings, rate.point, setup.format, CodedState{})),
      live_(settings.live.has_value()),
      position_(setup.before) {
  scene_.setup = setup;
  scene_.setup.patterns = patterns_->store();
}

Result<void> PlanarScene::push(const Picture& picture, std::uint32_t duration) {
  if (ended_) begin_again();
  GlobalMotion::Observation seen = global_.observe(picture);
  if (!plane_.covers(seen.since_first)) {
    if (auto ended = finish(); !ended) return ended;
    begin_again();
    seen = global_.observe(picture);
  }
  observed_.push_back({plane_.pose(seen.since_first), PicturePlane::quadratic(seen), duration});
  const double kept = live_ ? 1 - 1 / std::max(1.0, fps_of(scene_.setup.format)) : 1;
  moved_ = kept * moved_ + seen.moved;
  still_ = kept * still_ + seen.still;
  if (auto added = patterns_->add(picture); !added) return added;
  ++pictures_;
  position_.add(duration > 0 ? duration : timing_.nominal_duration);
  return timing_.group_ends(++in_group_, pictures_) ? end_group() : Result<void>{};
}

void PlanarScene::cut() {
  global_.cut();
  patterns_->cut();
}

void PlanarScene::begin_again() {
  ended_ = requested_ = false;
  global_ = {};
  scene_.setup.before = position_;
  pictures_ = 0;
  if (packets_.started()) packets_.begin_again();
}

Result<void> PlanarScene::begin_motion() {
  moving_ = moves();
  // A plane that rests need not be sent: without a geometry the decoder shows the same.
  const auto numbers = numbers_of(plane_.rest());
  const CodedState rest = moving_ ? coded_state(numbers, scene_.setup) : CodedState{};
  const State rest_state = state_of(rest, scene_.setup.steps);
  scene_.geometry.emplace(geometry_of(scene_.setup, moving_ ? plane_.geometry() : no_plane(), rest_state));
  scene_.patterns.clear();
  scene_.patterns.push_back(make_pattern({}, rest_state, scene_.geometry));
  motion_ = MotionTrack(scene_.setup, rest, rate_, timing_.nominal_duration);
  patterns_->begin_scene(rest);
  auto setup = encode_setup(scene_.setup);
  if (!setup) return fail(setup.error());
  packets_.start({std::move(*setup), moving_ ? plane_.payload() : std::vector<std::uint8_t>{}, {}, {}});
  return {};
}

Result<void> PlanarScene::end_group() {
  if (in_group_ > 0) groups_.push_back(std::exchange(in_group_, 0));
  return patterns_->segment_ends(timing_.group_pictures) ? end_segment() : Result<void>{};
}

Result<void> PlanarScene::add_motion() {
  auto next = observed_.begin();
  for (const std::size_t pictures : groups_) {
    std::vector<PictureCost> costs(pictures);
    std::vector<std::uint32_t> durations;
    for (PictureCost& cost : costs) {
      if (!moving_) {
        next->pose = pose_of(state_of({}, scene_.setup.steps));
        next->quadratic = {};
      }
      const auto numbers = numbers_of(next->pose);
      std::copy(numbers.begin(), numbers.end(), cost.fit.begin());
      cost.layers.push_back({CostLayer::kHead, 0, 0, cv::Mat1d::zeros(kParameterCount, kParameterCount)});
      cv::Mat(next->quadratic).copyTo(cost.layers.back().quadratic(cv::Rect(0, 0, kPoseCount, kPoseCount)));
      durations.push_back(next++->duration);
    }
    auto group = motion_.add(costs, durations);
    if (!group) return fail(group.error());
    patterns_->add(group->states, std::move(group->payload));
  }
  return {};
}

Result<void> PlanarScene::end_segment() {
  if (groups_.empty()) return {};
  if (!packets_.started())
    if (auto begun = begin_motion(); !begun) return begun;
  if (auto added = add_motion(); !added) return added;
  const auto packets = patterns_->end_segment(scene_, packets_.counted(), {});
  if (!packets) return fail(packets.error());
  for (const auto& [type, payload] : *packets) packets_.add(type, payload);
  packets_.count_from_here();
  observed_.clear();
  groups_.clear();
  if (!live_) moved_ = still_ = 0;
  ended_ = key_interval_ == 0 || static_cast<double>(pictures_ + timing_.group_pictures) > key_interval_ ||
           (live_ && ((!moving_ && moves()) || requested_));
  return {};
}

Result<void> PlanarScene::finish() {
  if (auto ended = end_group(); !ended) return ended;
  return end_segment();
}

}  // namespace fbs
