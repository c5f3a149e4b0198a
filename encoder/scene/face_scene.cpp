#include "encoder/scene/face_scene.h"

#include <algorithm>
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

/// Pictures that may be analysed and not yet coded, with several threads. Of a live scene, a group: its
/// packets must not be later than one group's coding. Of a file, as many as there is memory for their costs:
/// a segment takes long.
std::size_t pictures_ahead(const VideoFormat& format, const EncoderSettings& settings) {
  if (thread_count(settings) == 1) return 0;
  if (settings.live) return SceneTiming(format, settings).group_pictures;
  constexpr std::size_t kBytes = 40'000'000;
  return kBytes / (sizeof(double) * kParameterCount * kParameterCount);
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

  const Picture& shown = settings.first_pattern ? *settings.first_pattern : first;
  const bool alone = settings.patterns == 1;
  FirstPattern first_pattern(format, shown, alone ? Effort::of(settings.effort).pattern_speed : kTrialSpeed);
  const double eye = adapted->pose.eye_distance_px();
  const auto rate = plan_rate(motion_target(settings, eye), geometry->payload.size() + kOtherStartupBytes,
                              [&](int quantiser) { return first_pattern.bytes(quantiser); });
  if (!rate) return fail(rate.error());
  Scene scene;
  scene.setup.before = before;
  scene.setup.format = format;
  scene.setup.parts = parts_of(settings);
  scene.setup.steps = rate->point.steps;
  const CodedState seen_coded = coded_state(numbers_of(adapted->pose), scene.setup);
  const State seen = state_of(seen_coded, scene.setup.steps);
  // Where there are several patterns, the first segment codes this one, too. Until then pictures are compared
  // with it as coded on trial or, where there is no time for that, with its source.
  auto coded = alone || !settings.live ? first_pattern.take(rate->point.pattern_quantiser)
                                       : Result<CodedPattern>(CodedPattern{{}, shown});
  if (!coded) return fail(coded.error());
  auto payload = alone ? encode_first_pattern({0, 0, seen_coded, std::move(coded->av1)}, scene.setup)
                       : std::vector<std::uint8_t>{};
  if (!payload) return fail(payload.error());
  // At first the surround is guessed by distance from the face.
  SurroundObservations observations(format);
  observations.set_first(first, seen);
  const SurroundMap guess = fit_surround(scene.setup, geometry->decoded, observations);
  scene.geometry.emplace(scene.setup, geometry->decoded, guess, seen);
  scene.patterns.push_back(make_pattern(std::move(coded->decoded), seen, scene.geometry));

  // A picture from elsewhere cannot be the reference of the motion.
  const Picture pattern_seen = settings.first_pattern ? first : scene.patterns.front().picture;
  return std::unique_ptr<FaceScene>(
      new FaceScene(finder, settings, {first, pattern_seen, adapted->pose.shift},
                    {std::move(scene), seen_coded, eye, *rate, std::move(geometry->payload),
                     std::move(*payload), std::move(observations)},
                    pictures_ahead(format, settings)));
}

FaceScene::FaceScene(const FaceFinder& finder, const EncoderSettings& settings, const FirstPicture& first,
                     FaceCoder::Start start, std::size_t ahead)
    : analysis_(settings, finder,
                {start.scene.setup, start.scene.geometry->geometry(), first.picture, first.pattern,
                 start.scene.patterns.front().seen, first.centre, start.eye_distance_px,
                 thread_count(settings), settings.hooks}),
      // A viewer who joins a live scene, or at a key interval, does not know those before.
      can_go_on_(settings.patterns != 1 && !settings.live && settings.key_interval == 0),
      coder_(settings, std::move(start)),
      coding_(ahead, "fbs-code", settings.hooks),
      analysing_(std::min<std::size_t>(ahead, 1), "fbs-analyse", settings.hooks) {}

Result<void> FaceScene::code(std::function<Result<void>()> task) {
  return coding_.add([this, task = std::move(task)]() -> Result<void> {
    if (auto done = task(); !done) return done;
    const auto bytes = coder_.ledger().packets().take();
    const std::lock_guard lock(mutex_);
    ready_.insert(ready_.end(), bytes.begin(), bytes.end());
    return {};
  });
}

Result<void> FaceScene::code_later(std::function<Result<void>()> task) {
  return analysing_.add([this, task = std::move(task)] { return code(task); });
}

Result<void> FaceScene::change(const std::function<void(SceneLedger&)>& how) {
  return code_later([this, how]() -> Result<void> {
    how(coder_.ledger());
    return {};
  });
}

Result<void> FaceScene::leave() {
  return code_later([this] { return coder_.leave(); });
}

Result<void> FaceScene::push(const Picture& picture, const PictureTime& when) {
  const auto task = [this, shared = SharedPicture(picture), when,
                     cut = std::exchange(cut_, false)]() -> Result<void> {
    auto seen = analysis_.observe(shared);
    if (auto kept = waiting_.push(shared); !kept) return kept;
    return code([this, seen = std::move(seen), when, cut]() mutable -> Result<void> {
      const auto next = waiting_.pop();
      if (!next) return fail(next.error());
      if (cut) coder_.cut();
      return coder_.add(*next, std::move(seen), when);
    });
  };
  return analysing_.add(task);
}

StreamPosition FaceScene::end_picture(std::optional<std::uint64_t> time) {
  analysing_.settle();
  coding_.settle();
  if (time) coder_.ledger().end_picture(*time);
  return coder_.ledger().position();
}

Result<void> FaceScene::finish() {
  return code_later([this] { return coder_.finish(); });
}

Result<void> FaceScene::wait() {
  if (auto done = analysing_.wait(); !done) return done;
  return coding_.wait();
}

std::vector<std::uint8_t> FaceScene::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(ready_, {});
}

}  // namespace fbs
