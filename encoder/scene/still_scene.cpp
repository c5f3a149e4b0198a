#include "encoder/scene/still_scene.h"

#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/track.h"
#include "encoder/patterns/first_pattern.h"
#include "encoder/plan/group_plan.h"
#include "encoder/plan/rate_control.h"
#include "encoder/plan/rate_target.h"

namespace fbs {
namespace {

constexpr double kUsualEyeDistance = 64;  // pixels; quality is defined relative to a face, and there is none

}  // namespace

StillScene::StillScene(const Setup& setup, const SceneTiming& timing)
    : timing_(timing),
      parts_(setup.parts),
      coder_(setup, CodedState{}),
      clock_(setup.before, timing.nominal_duration) {}

Result<std::unique_ptr<SceneEncoder>> StillScene::begin(const VideoFormat& format,
                                                        const EncoderSettings& settings, const Picture& first,
                                                        const StreamPosition& before) {
  Setup setup;
  setup.before = before;
  setup.format = format;
  setup.parts = mask_of(PartId::kPose);
  FirstPattern pattern(format, first);
  const auto rate = plan_rate(rate_target(settings, kUsualEyeDistance), kOtherStartupBytes,
                              [&](int quantiser) { return pattern.bytes(quantiser); });
  if (!rate) return fail(rate.error());
  setup.steps = rate->point.steps;
  auto coded = pattern.take(rate->point.pattern_quantiser);
  if (!coded) return fail(coded.error());

  SceneHead head;
  auto setup_payload = encode_setup(setup);
  if (!setup_payload) return fail(setup_payload.error());
  head.setup = std::move(*setup_payload);
  const PatternSyntax first_pattern{0, 0, CodedState{}, std::move(coded->av1)};
  auto pattern_payload = encode_first_pattern(first_pattern, setup);
  if (!pattern_payload) return fail(pattern_payload.error());
  head.pattern = std::move(*pattern_payload);

  std::unique_ptr<StillScene> scene(new StillScene(setup, SceneTiming(format, settings)));
  scene->packets_.start(head);
  return scene;
}

Result<void> StillScene::push(const Picture&, const PictureTime& when) {
  clock_.add(when);
  ++pictures_;
  const bool ends = timing_.group_ends(clock_.pictures(), clock_.lasts(), clock_.last(), pictures_);
  return ends || pictures_ == timing_.key_pictures ? end_group() : Result<void>{};
}

Result<void> StillScene::end_group() {
  if (clock_.pictures() == 0) return {};
  const std::vector<std::uint32_t> durations = clock_.end_group();
  const CodedState& anchor = coder_.anchor();
  MotionGroup group = knots_everywhere(anchor, std::vector(durations.size(), anchor), parts_);
  group.key = coder_.groups() == 0;
  group.first = coder_.next();
  group.durations = group_durations(durations, timing_.nominal_duration);
  const auto payload = coder_.encode(group);
  if (!payload) return fail(payload.error());
  packets_.add_motion(*payload);
  return {};
}

}  // namespace fbs
