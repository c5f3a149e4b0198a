#include "encoder/scene/face_scene.h"

#include <initializer_list>
#include <utility>

#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "encoder/find/adapt.h"
#include "encoder/model/coded_numbers.h"
#include "encoder/patterns/first_pattern.h"
#include "encoder/plan/rate_target.h"
#include "encoder/segment/pass_settings.h"
#include "encoder/surround/surround_fit.h"

namespace fbs {
namespace {

/// The parts of the state that are sent. Lower lids have neither a snake nor enough in the picture to fit.
PartMask parts_of(const EncoderSettings& settings) {
  PartMask parts = mask_of(PartId::kPose);
  const auto add = [&](std::initializer_list<PartId> ids) {
    for (const PartId id : ids) parts = static_cast<PartMask>(parts | mask_of(id));
  };
  if (settings.surround) add({PartId::kBody, PartId::kGround});
  if (settings.expression) add({PartId::kMouth, PartId::kBrows, PartId::kUpperLids});
  if (settings.track_only) return parts;  // no contour shows the others
  add({PartId::kLight, PartId::kMouthInterior});
  if (settings.expression) add({PartId::kGaze});
  return parts;
}

}  // namespace

Result<std::unique_ptr<SceneEncoder>> FaceScene::begin(const VideoFormat& format,
                                                       const EncoderSettings& settings,
                                                       const FaceFinder& finder, const Picture& first,
                                                       const Marks& marks, const StreamPosition& before) {
  const auto adapted = adapt_head(marks);
  if (!adapted) return fail(adapted.error());
  auto geometry = encode_geometry(adapted->geometry);
  if (!geometry) return fail(geometry.error());

  // With several patterns, pictures are compared with this one only until the segment's are coded.
  const Picture& shown = settings.first_pattern ? *settings.first_pattern : first;
  FirstPattern first_pattern(format, shown, settings.patterns == 1 ? kSentSpeed : kTrialSpeed);
  const double eye = adapted->pose.eye_distance_px();
  const auto rate = plan_rate(motion_target(settings, eye), geometry->payload.size() + kOtherStartupBytes,
                              [&](int quantiser) { return first_pattern.bytes(quantiser); });
  if (!rate) return fail(rate.error());
  auto coded = first_pattern.take(rate->point.pattern_quantiser);
  if (!coded) return fail(coded.error());

  Scene scene;
  scene.setup.before = before;
  scene.setup.format = format;
  scene.setup.parts = parts_of(settings);
  scene.setup.steps = rate->point.steps;
  const CodedState seen_coded = coded_state(numbers_of(adapted->pose), scene.setup);
  const State seen = state_of(seen_coded, scene.setup.steps);
  const PatternSyntax first_syntax{0, 0, seen_coded, std::move(coded->av1)};
  auto pattern = encode_first_pattern(first_syntax, scene.setup);
  if (!pattern) return fail(pattern.error());
  // At first the surround is guessed by distance from the face.
  SurroundObservations observations(format);
  observations.set_first(first, seen);
  const SurroundMap guess = fit_surround(scene.setup, geometry->decoded, observations);
  scene.geometry.emplace(scene.setup, geometry->decoded, guess, seen);
  scene.patterns.push_back(make_pattern(std::move(coded->decoded), seen, scene.geometry));

  const SceneTiming timing(format, settings);
  // A picture from elsewhere cannot be the reference of the motion.
  const Picture pattern_seen = settings.first_pattern ? first : scene.patterns.front().picture;
  return std::unique_ptr<FaceScene>(
      new FaceScene(timing, finder, settings, {first, pattern_seen, adapted->pose.shift},
                    {std::move(scene), seen_coded, eye, *rate, std::move(geometry->payload),
                     std::move(*pattern), std::move(observations)}));
}

FaceScene::FaceScene(const SceneTiming& timing, const FaceFinder& finder, const EncoderSettings& settings,
                     const FirstPicture& first, FaceCoder::Start start)
    : timing_(timing),
      analysis_(settings, finder,
                {start.scene.setup, start.scene.geometry->geometry(), first.picture, first.pattern,
                 start.scene.patterns.front().seen, first.centre, start.eye_distance_px}),
      coder_(settings, std::move(start)),
      ahead_(settings.live && coder_.has_several_patterns() && thread_count(settings) > 1) {}

void FaceScene::request_scene() {
  if (ahead_)
    requested_ = pictures_ > 0;  // otherwise the next picture begins one anyway
  else
    coder_.request_scene();
}

Result<void> FaceScene::set_bitrate(double kbps) {
  if (auto done = coding_.wait(); !done) return done;
  coder_.set_bitrate(kbps);
  return {};
}

Result<void> FaceScene::lose_patterns() {
  if (auto done = coding_.wait(); !done) return done;
  coder_.lose_patterns();
  return {};
}

Result<void> FaceScene::push(const Picture& picture, std::uint32_t duration) {
  if (!ahead_) {
    if (std::exchange(cut_, false)) coder_.cut();
    if (auto done = coder_.add(picture, observed(picture), duration); !done) return done;
    learn_from_coder();
    return {};
  }
  if (std::exchange(coder_leads_, false)) {
    if (auto done = coding_.wait(); !done) return done;
    learn_from_coder();
  }
  FaceAnalysis::Observation seen = observed(picture);
  group_.push_back({picture, std::move(seen), duration, std::exchange(cut_, false)});
  ++pictures_;
  return timing_.group_ends(group_.size(), pictures_) ? code_group() : Result<void>{};
}

FaceAnalysis::Observation FaceScene::observed(const Picture& picture) {
  if (std::exchange(begins_, false)) analysis_.begin_scene();
  return analysis_.observe(picture);
}

void FaceScene::learn_from_coder() {
  begins_ = coder_.scene_ended();
  if (const auto map = coder_.take_new_map()) analysis_.set_surround_map(*map);
}

Result<void> FaceScene::code(Seen seen) {
  if (seen.cut) coder_.cut();
  return coder_.add(seen.picture, std::move(seen.observation), seen.duration);
}

Result<void> FaceScene::code_group() {
  const bool first = pictures_ == group_.size(), learns = !learned_ && pictures_ >= timing_.lookahead,
             requested = requested_ && !first, last = requested || coder_.live_scene_ends(pictures_);
  coder_leads_ = first || learns || last;
  learned_ = (learned_ || learns) && !last;
  if (last) {
    pictures_ = 0;
    requested_ = false;
  }
  return coding_.start([this, requested, group = std::exchange(group_, {})]() mutable -> Result<void> {
    if (requested) coder_.request_scene();
    for (Seen& seen : group)
      if (auto done = code(std::move(seen)); !done) return done;
    return {};
  });
}

Result<void> FaceScene::finish() {
  if (auto done = coding_.wait(); !done) return done;
  for (Seen& seen : std::exchange(group_, {}))
    if (auto done = code(std::move(seen)); !done) return done;
  return coder_.finish();
}

std::vector<std::uint8_t> FaceScene::take() {
  return coding_.is_idle() ? coder_.take() : std::vector<std::uint8_t>{};
}

}  // namespace fbs
