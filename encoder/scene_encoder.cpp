#include "encoder/scene_encoder.h"

#include <algorithm>
#include <cmath>

#include "bitstream/packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/pattern_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/track.h"
#include "decoder/pattern_decoder.h"
#include "encoder/patterns/pattern_encoder.h"
#include "encoder/surround/surround_fit.h"

namespace fbs {
namespace {

constexpr double kLookaheadSeconds = 2;  // that the surround's map is learned from
constexpr std::size_t kSurroundPictures = 12;
constexpr std::size_t kPacketBytes = 5;  // of a motion packet round its payload

/// Marks that the snakes have corrected: where the curves came to rest on the first picture, lips and lids
/// get new marks, unless a curve has strayed. Then the head is adapted again. Brows keep theirs: a brow's
/// snake on a small face may settle on the lid or the hair (claire: brow error 19 % -> 33 % of the eye
/// distance).
Result<AdaptedHead> adapt_with_snakes(const Picture& picture, Marks marks) {
  constexpr double kStrayed = 0.12;  // eye distances
  auto adapted = adapt_head(marks);
  if (!adapted) return adapted;
  const double eye = adapted->pose.eye_distance_px();
  const WorkFrame frame = WorkFrame::cut(picture, adapted->pose.shift, eye, true);
  const PoseProjection projection(adapted->pose);
  for (const auto& [vertex, place] : FeatureTracker(adapted->geometry, adapted->pose, frame).vertices()) {
    const int on = generic_head().vertices[vertex].feature;
    if (on == static_cast<int>(FeatureId::kBrowRight) || on == static_cast<int>(FeatureId::kBrowLeft))
      continue;
    const glm::dvec2 seen = projection(place),
                     was = projection(glm::dvec3(adapted->geometry.positions[vertex]));
    if (std::hypot(seen.x - was.x, seen.y - was.y) < kStrayed * eye) marks.vertex[vertex] = seen;
  }
  return adapt_head(marks);
}

PartMask parts_of(const EncoderSettings& settings) {
  PartMask parts = mask_of(PartId::kPose) | mask_of(PartId::kLight) | mask_of(PartId::kMouthInterior);
  if (settings.surround)
    parts = static_cast<PartMask>(parts | mask_of(PartId::kBody) | mask_of(PartId::kGround));
  // Pupils have no curve; the fit to the picture finds them.
  if (settings.snakes)
    for (const PartId part : {PartId::kMouth, PartId::kBrows, PartId::kUpperLids, PartId::kGaze})
      parts = static_cast<PartMask>(parts | mask_of(part));
  return parts;
}

/// The pose in whole steps, all else at rest.
CodedState coded_pose(const Pose& pose, const QuantiserSteps& steps) {
  CodedState coded{};
  const auto numbers = numbers_of(pose);
  for (std::size_t i = 0; i < kPoseCount; ++i)
    coded[i] = static_cast<std::int32_t>(std::lround(numbers[i] / step_of(steps, i)));
  return coded;
}

/// What a viewer sees of lips and lids that are not where they should be, beyond what squared differences
/// say: in bits that would be well spent to have them right.
cv::Mat1d wrong_expression() {
  constexpr double kTolerance = 0.03 * kUnitsPerEyeDistance;
  const cv::Mat1d even = cv::Mat1d::eye(kCoefficientCount, kCoefficientCount) / (kTolerance * kTolerance);
  cv::Mat1d form = cv::Mat1d::zeros(kParameterCount, kParameterCount);
  const cv::Range coefficients(kFirstCoefficient, kParameterCount);
  quadratic_of_coefficients(even).copyTo(form(coefficients, coefficients));
  return form;
}

Result<std::vector<std::uint8_t>> first_pattern(const VideoFormat& format, const Picture& picture,
                                                int quantiser) {
  auto encoder = PatternEncoder::create(format, quantiser);
  if (!encoder) return fail(encoder.error());
  return encoder->encode(picture);
}

double pictures_per_second(const VideoFormat& f) {
  return static_cast<double>(f.frame_rate.num) / static_cast<double>(f.frame_rate.den);
}

}  // namespace

SceneEncoder::SceneEncoder(const VideoFormat& format, const EncoderSettings& settings) : settings_(settings) {
  const double fps = pictures_per_second(format);
  group_pictures_ = settings.group_pictures > 0
                        ? settings.group_pictures
                        : std::clamp(static_cast<int>(std::lround(fps)), 1, kMaxGroupPictures);
  lookahead_ = std::max(1, static_cast<int>(std::lround(fps * kLookaheadSeconds)));
  scene_.setup.format = format;
}

Result<SceneEncoder> SceneEncoder::begin(const VideoFormat& format, const EncoderSettings& settings,
                                         const FaceFinder& finder, const Picture& first, const Marks& marks) {
  auto adapted = settings.marks ? adapt_head(marks) : adapt_with_snakes(first, marks);
  if (!adapted) return fail(adapted.error());
  SceneEncoder scene(format, settings);
  scene.search_.emplace(finder);
  scene.eye_distance_px_ = adapted->pose.eye_distance_px();
  scene.scene_.setup.parts = parts_of(settings);
  const WorkFrame frame = WorkFrame::cut(first, adapted->pose.shift, scene.eye_distance_px_, true);
  auto geometry = encode_geometry(adapted->geometry);
  if (!geometry) return fail(geometry.error());
  scene.geometry_bytes_ = std::move(geometry->payload);
  auto chosen = scene.choose_point(first);
  if (!chosen) return fail(chosen.error());
  const OperatingPoint& point = *chosen;
  scene.seen_coded_ = coded_pose(adapted->pose, point.steps);
  scene.seen_ = state_of(scene.seen_coded_, point.steps);
  // Until pictures have shown better, the surround is a guess by distance from the face.
  scene.observations_.emplace(format).set_first(first, scene.seen_);
  scene.scene_.geometry.emplace(scene.scene_.setup, geometry->decoded,
                                fit_surround(scene.scene_.setup, geometry->decoded, *scene.observations_),
                                scene.seen_);
  const Pose seen_pose = pose_of(scene.seen_);
  scene.head_.emplace(geometry->decoded, seen_pose, frame);
  scene.features_.emplace(geometry->decoded, seen_pose, frame);
  scene.now_.pose = seen_pose;
  scene.lambda_ = point.lambda;
  scene.planner_.emplace(point.steps, scene.scene_.setup.parts, point.lambda,
                         wrong_expression() * point.lambda / 2);
  if (auto added = scene.add_pattern(first, point.pattern_quantiser); !added) return fail(added.error());
  const WorkFrame decoded = WorkFrame::cut(scene.scene_.patterns.front().picture, adapted->pose.shift,
                                           scene.eye_distance_px_, false);
  scene.fit_.emplace(scene.scene_.setup, geometry->decoded, decoded, scene.seen_);
  if (settings.surround) scene.surround_.emplace(first, scene.seen_);
  scene.coder_.emplace(scene.scene_.setup, scene.seen_coded_);
  return scene;
}

Result<SceneEncoder> SceneEncoder::begin_without_face(const VideoFormat& format,
                                                      const EncoderSettings& settings, const Picture& first) {
  SceneEncoder scene(format, settings);
  scene.eye_distance_px_ = 64;  // of a face, had it one
  scene.scene_.setup.parts = mask_of(PartId::kPose);
  auto chosen = scene.choose_point(first);
  if (!chosen) return fail(chosen.error());
  const OperatingPoint& point = *chosen;
  if (auto added = scene.add_pattern(first, point.pattern_quantiser); !added) return fail(added.error());
  scene.coder_.emplace(scene.scene_.setup, scene.seen_coded_);
  return scene;
}

Result<OperatingPoint> SceneEncoder::choose_point(const Picture& first) {
  constexpr double kSecondsUnknown = 10;
  constexpr double kLeastMotion = 0.15;     // of the rate, whatever the startup takes
  constexpr std::size_t kOtherBytes = 160;  // setup, surround, heads of packets
  int quality = settings_.quality;
  double motion = settings_.motion_bitrate;
  if (settings_.bitrate > 0) {
    const double seconds = settings_.seconds > 0 ? settings_.seconds : kSecondsUnknown;
    Result<void> failed;
    const auto startup = [&](int q) {
      const auto av1 = first_pattern(scene_.setup.format, first,
                                     OperatingPoint::at(q, eye_distance_px_).pattern_quantiser);
      if (!av1) failed = fail(av1.error());
      return geometry_bytes_.size() + kOtherBytes + (av1 ? av1->size() : 0);
    };
    quality = quality_for(settings_.bitrate, seconds, startup);
    const double rest = settings_.bitrate - 8e-3 * static_cast<double>(startup(quality)) / seconds;
    if (!failed) return fail(failed.error());
    motion = std::max(rest, kLeastMotion * settings_.bitrate);
  }
  if (motion > 0) budget_.emplace(motion);
  const OperatingPoint point = OperatingPoint::at(quality, eye_distance_px_);
  scene_.setup.steps = point.steps;
  return point;
}

Result<void> SceneEncoder::add_pattern(const Picture& picture, int quantiser) {
  const VideoFormat& format = scene_.setup.format;
  auto av1 = first_pattern(format, picture, quantiser);
  if (!av1) return fail(av1.error());
  auto decoder = PatternDecoder::create(format.width, format.height);
  if (!decoder) return fail(decoder.error());
  auto decoded = decoder->decode(*av1);
  if (!decoded) return fail(decoded.error());
  auto payload = encode_pattern({0, seen_coded_, std::move(*av1)}, scene_.setup);
  if (!payload) return fail(payload.error());
  pattern_bytes_ = std::move(*payload);
  scene_.patterns.push_back(
      {std::move(*decoded), scene_.geometry ? scene_.geometry->project(seen_) : ScreenMesh{}});
  return {};
}

std::optional<TrackedPose> SceneEncoder::follow_head(const Picture& picture, const HeadVertices& vertices,
                                                     WorkFrame& frame) {
  const Pose last_good = now_.pose;
  // The flow of pictures that do not show the head says nothing: once lost, it is searched for.
  if (!search_->lost()) {
    const TrackedPose tracked = head_->track(frame, vertices);
    analysis_.confidence = tracked.confidence;
    if (tracked.confidence >= FaceSearch::kLostBelow) return tracked;
  }
  const FaceSearch::Detection found = search_->find(picture, *head_, last_good, vertices);
  analysis_.confidence = found.head.confidence;
  if (found.accepted) {
    search_->rest();
    frame = WorkFrame::cut(picture, found.head.pose.shift, eye_distance_px_, true);
    head_->restart(found.head.pose, frame);
    const TrackedPose tracked = head_->track(frame, vertices);
    analysis_.confidence = tracked.confidence;
    return tracked;
  }
  head_->restart(last_good, frame);
  return std::nullopt;
}

Fit SceneEncoder::relaxed() {
  constexpr double kRemains = 0.85;  // of the expression, per picture
  Fit fit = now_;
  for (glm::dvec2& o : fit.offsets) o *= kRemains;
  features_->set_offsets(fit.offsets);
  return fit;
}

Fit SceneEncoder::analyse(const Picture& picture, PictureCost& cost) {
  const HeadVertices vertices = fit_->deformed(now_);
  WorkFrame frame = WorkFrame::cut(picture, head_->pose().shift, eye_distance_px_, true);
  const std::optional<TrackedPose> seen = follow_head(picture, vertices, frame);
  if (!seen) {
    const Fit fit = relaxed();
    cost = cost_unseen(fit);
    return fit;
  }
  Fit tracked{seen->pose, now_.light, now_.interior, now_.offsets};
  if (settings_.snakes) {
    features_->track(frame, tracked.pose, head_->flow());
    tracked.offsets = features_->offsets();
    for (const FeatureId id : {FeatureId::kPupilRight, FeatureId::kPupilLeft}) {
      const auto c = feature(id).first_control;
      tracked.offsets[c] = now_.offsets[c];
    }
  }
  fit_->look_at(frame, scene_.setup.mouth);
  tracked = fit_->with_best_lids(tracked);
  const Fit fit = settings_.refine ? fit_->refine_mouth(tracked) : tracked;
  cost = fit_->cost_at(fit);
  return fit;
}

void SceneEncoder::report(const State& state) {
  analysis_.face = true;
  const auto points = scene_.geometry->project_vertices(state);
  for (std::size_t v = 0; v < kVertexCount; ++v)
    analysis_.vertices[v] = glm::dvec2(points[v].x, points[v].y) / 64.0;
  const PoseProjection projection(head_->pose());
  analysis_.snakes.clear();
  for (std::size_t i = 0; i < features_->count(); ++i) {
    SnakeOutline curve{{}, features_->is_closed(i), features_->iterations(i)};
    for (const glm::dvec3& p : features_->outline(i)) curve.points.push_back(projection(p));
    analysis_.snakes.push_back(std::move(curve));
  }
}

Result<void> SceneEncoder::push(const Picture& picture, std::uint32_t duration) {
  if (scene_.geometry) {
    PictureCost cost;
    if (pictures_ > 0) {
      now_ = analyse(picture, cost);
    } else {
      fit_->look_at(WorkFrame::cut(picture, now_.pose.shift, eye_distance_px_, false), scene_.setup.mouth);
      cost = fit_->cost_at(now_);
      analysis_.confidence = 1;
    }
    State state = state_of(now_);
    if (surround_) {
      surround_->observe(picture, now_.pose);
      surround_->add_to(cost);
      surround_->add_to(state);
    }
    costs_.push_back(std::move(cost));
    report(state);
    if (!started_) {
      mouth_colours_.add(picture, scene_.geometry->project_vertices(state),
                         mouth_height(scene_.geometry->project_vertices(seen_)), eye_distance_px_);
    }
    const auto every =
        static_cast<std::uint64_t>(std::max(1, lookahead_ / static_cast<int>(kSurroundPictures)));
    if (surround_ && !started_ && pictures_ > 0 && pictures_ % every == 0) observations_->add(picture, state);
  }
  durations_.push_back(duration);
  ++pictures_;
  // The first picture is a group of its own: a viewer need not wait for more.
  if (pictures_ == 1 || static_cast<int>(durations_.size()) == group_pictures_)
    if (auto ended = end_group(); !ended) return ended;
  if (!started_ && pictures_ >= static_cast<std::uint64_t>(lookahead_)) return start();
  return {};
}

void SceneEncoder::finish_group(MotionGroup& group, bool key) const {
  group.key = key;
  if (std::all_of(durations_.begin(), durations_.end(), [](std::uint32_t d) { return d == 0; })) return;
  group.durations = durations_;
  for (std::uint32_t& d : group.durations)
    if (d == 0) d = nominal_duration(scene_.setup.format.frame_rate);
}

MotionGroup SceneEncoder::plan_group(const CodedState& anchor, bool key) {
  MotionGroup group;
  const auto bits_at = [&](double lambda) {
    planner_->set_lambda(lambda);
    group = planner_->plan(anchor, costs_, rate_);
    finish_group(group, key);
    const auto payload = MotionCoder(*coder_).encode(group);
    return 8.0 * static_cast<double>((payload ? payload->size() : 0) + kPacketBytes);
  };
  if (!budget_) return planner_->plan(anchor, costs_, rate_);
  double seconds = 0;
  for (const std::uint32_t d : durations_)
    seconds += (d > 0 ? d : nominal_duration(scene_.setup.format.frame_rate)) / 90000.0;
  const double lambda = lambda_for(budget_->allowed(seconds), planner_->lambda(), lambda_, bits_at);
  budget_->spend(bits_at(lambda), seconds);
  return group;
}

Result<void> SceneEncoder::end_group() {
  if (durations_.empty()) return {};
  const bool key = coder_->needs_key();
  const CodedState& anchor = coder_->anchor(key);
  MotionGroup group =
      scene_.geometry ? plan_group(anchor, key)
                      : knots_everywhere(anchor, std::vector(durations_.size(), anchor), scene_.setup.parts);
  finish_group(group, key);
  auto payload = coder_->encode(group);
  if (!payload) return fail(payload.error());
  rate_.learn(group);
  write_packet(started_ ? ready_ : held_back_, PacketType::kMotion, *payload);
  costs_.clear();
  durations_.clear();
  return {};
}

Result<void> SceneEncoder::start() {
  // Only the chroma: the luma has been fitted as State::inside since the first picture, on what setup says.
  const MouthInterior colours = mouth_colours_.colours();
  for (const auto& [to, from] :
       {std::pair{&scene_.setup.mouth.upper, colours.upper}, {&scene_.setup.mouth.lower, colours.lower}}) {
    to->u = from.u;
    to->v = from.v;
  }
  auto setup = encode_setup(scene_.setup);
  if (!setup) return fail(setup.error());
  write_packet(ready_, PacketType::kSetup, *setup);
  if (scene_.geometry) {
    const SurroundMap map = surround_
                                ? fit_surround(scene_.setup, scene_.geometry->geometry(), *observations_)
                                : still_surround();
    if (surround_) surround_->set_map(map);
    auto surround = encode_surround(map);
    if (!surround) return fail(surround.error());
    write_packet(ready_, PacketType::kGeometry, geometry_bytes_);
    write_packet(ready_, PacketType::kSurround, *surround);
    const Geometry geometry = scene_.geometry->geometry();  // outlives the object that emplace destroys
    scene_.geometry.emplace(scene_.setup, geometry, map, seen_);
    scene_.patterns.front().seen = scene_.geometry->project(seen_);
  }
  write_packet(ready_, PacketType::kPattern, pattern_bytes_);
  ready_.insert(ready_.end(), held_back_.begin(), held_back_.end());
  held_back_.clear();
  observations_.reset();
  started_ = true;
  return {};
}

Result<void> SceneEncoder::finish() {
  if (auto ended = end_group(); !ended) return ended;
  return started_ ? Result<void>{} : start();
}

std::vector<std::uint8_t> SceneEncoder::take() {
  return std::exchange(ready_, {});
}

}  // namespace fbs
