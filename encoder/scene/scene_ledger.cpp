#include "encoder/scene/scene_ledger.h"

#include <utility>

#include "bitstream/payload/return_payload.h"

namespace fbs {

SceneLedger::SceneLedger(const Setup& setup, const CodedState& seen, const RatePlan& rate,
                         const EncoderSettings& settings, std::unique_ptr<PatternStage> patterns)
    : timing_(setup.format, settings),
      rate_(rate),
      live_(settings.live.has_value()),
      patterns_(std::move(patterns)),
      motion_(setup, seen, rate, timing_),
      clock_(setup.before, timing_.nominal_duration),
      begin_(setup.before.time),
      packets_(settings.live.value_or(LiveSettings{})) {}

Result<void> SceneLedger::add(const SharedPicture& picture, const PictureTime& when) {
  if (patterns_)
    if (auto added = patterns_->add(picture); !added) return added;
  clock_.add(when);
  ++pictures_;
  return {};
}

std::vector<std::uint32_t> SceneLedger::end_group() {
  std::vector<std::uint32_t> durations = clock_.end_group();
  if (patterns_) patterns_->end_group(durations);
  return durations;
}

Result<void> SceneLedger::plan(std::span<const PictureCost> costs, std::span<const std::uint32_t> durations) {
  auto group = motion_.add(costs, durations);
  if (!group) return fail(group.error());
  if (patterns_) {
    patterns_->add(group->states, std::move(group->payload));
  } else {
    packets_.add_motion(group->payload);
    packets_.end_group();
  }
  return {};
}

Result<void> SceneLedger::end_segment(Scene& scene, bool last, const StateRefit& refit) {
  const auto packets = patterns_->end_segment(scene, last, packets_.counted(), refit);
  if (!packets) return fail(packets.error());
  std::size_t group = 0;
  auto next = returns_.begin();
  for (const auto& [type, payload] : *packets) {
    if (next != returns_.end() && next->first == group) {
      packets_.add(PacketType::kReturn, encode_return(next->second));
      ++next;
    }
    packets_.add(type, payload);
    if (type == PacketType::kBlend || type == PacketType::kUnit) ++group;
  }
  returns_.clear();
  packets_.count_from_here();
  packets_.end_group();
  if (last) end_scene();
  return {};
}

void SceneLedger::go_on(const StreamPosition& at) {
  clock_.go_on(at);
  if (!ended_)
    returns_.emplace_back(patterns_->groups(), Return{0, at, false, static_cast<std::uint32_t>(pictures_)});
}

bool SceneLedger::scene_ends() const {
  return timing_.key_ticks > 0 ? requested_ || is_full() : patterns_ != nullptr;
}

void SceneLedger::begin_again(Setup& setup) {
  ended_ = requested_ = false;
  setup.before = clock_.position();
  begin_ = setup.before.time;
  pictures_ = 0;
  if (packets_.started()) packets_.begin_again();
}

void SceneLedger::begin_motion(const Setup& setup, const CodedState& seen) {
  motion_ = MotionTrack(setup, seen, rate_, timing_);
  if (patterns_) patterns_->begin_scene(seen);
}

}  // namespace fbs
