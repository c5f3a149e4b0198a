#include "encoder/pattern_pass.h"

#include <algorithm>
#include <numeric>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/payload/pattern_payload.h"
#include "encoder/blend/mode_choice.h"

namespace fbs {
namespace {

/// Numbers of pictures at regular distances, the first and the last among them.
std::vector<std::size_t> regular_times(std::size_t pictures, std::size_t count) {
  count = std::clamp<std::size_t>(count, 1, pictures);
  std::vector<std::size_t> out = {0};
  for (std::size_t k = 1; k < count; ++k) out.push_back((k * (pictures - 1) + (count - 1) / 2) / (count - 1));
  return out;
}

}  // namespace

void PatternPass::add(std::vector<State> states, std::vector<std::uint8_t> payload) {
  groups_.push_back({std::move(states), std::move(payload)});
}

Result<std::vector<SequencePattern>> PatternPass::code_patterns(std::span<const std::size_t> times) {
  std::vector<Picture> sources;
  for (const std::size_t time : times) {
    auto source = pictures_.read(time);
    if (!source) return fail(source.error());
    sources.push_back(std::move(*source));
  }
  auto coded = code_pattern_sequence(format_, sources, settings_.coding);
  if (!coded) return fail(coded.error());
  for (SequencePattern& p : *coded) p.picture = times[p.picture];
  return coded;
}

std::vector<std::size_t> PatternPass::arrivals(std::span<const SequencePattern> patterns) const {
  std::vector<std::size_t> out;
  std::size_t end = 0, sent = 1;
  for (const Group& g : groups_) {
    end += g.states.size();
    // The first group is shown from pattern 0 alone, so that a viewer need not wait for more.
    if (!out.empty()) {
      std::size_t next = ~std::size_t{0};  // the first picture at or behind the group's end that has a pattern
      for (const SequencePattern& p : patterns)
        if (p.picture + 1 >= end) next = std::min(next, p.picture);
      for (std::size_t k = sent; k < patterns.size(); ++k)
        if (patterns[k].picture <= next) sent = k + 1;
    }
    out.push_back(sent);
  }
  return out;
}

Result<std::vector<RegionModes>> PatternPass::choose(const Scene& scene, std::span<const State> states,
                                                     std::span<const std::size_t> arrivals) {
  int reduction = 0;
  while ((format_.width >> reduction) > 240) ++reduction;
  const BlendErrors blend(*scene.geometry, scene.patterns, reduction);
  std::vector<std::size_t> all(scene.patterns.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::vector<ModeErrors> errors;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (std::size_t i = 0; i < groups_[g].states.size(); ++i) {
      const auto source = pictures_.read(errors.size());
      if (!source) return fail(source.error());
      errors.push_back(blend.errors(source->y, states[errors.size()], std::span(all).first(arrivals[g])));
    }
  }
  return choose_modes(errors, settings_.lambda);
}

Result<std::vector<TypedPayload>> PatternPass::finish(Scene& scene, const CodedState& seen) {
  std::vector<State> states;
  for (const Group& g : groups_) states.insert(states.end(), g.states.begin(), g.states.end());
  for (std::size_t t = 0; t < states.size(); ++t) states[t].picture = static_cast<std::int32_t>(t);
  const std::vector<std::size_t> times = regular_times(states.size(), settings_.patterns);
  scene.setup.patterns = std::max<int>(2, static_cast<int>(times.size()));

  auto coded = code_patterns(times);
  if (!coded) return fail(coded.error());
  const State rest = scene.patterns.front().seen;
  scene.patterns.clear();
  for (const SequencePattern& p : *coded)
    scene.patterns.push_back(make_pattern(p.decoded, p.picture == 0 ? rest : states[p.picture], scene.geometry));
  const std::vector<std::size_t> arrived = arrivals(*coded);
  const auto modes = choose(scene, states, arrived);
  if (!modes) return fail(modes.error());

  std::vector<TypedPayload> out;
  BlendEncoder blend;
  std::size_t next_pattern = 0, next_motion = 0, with_motion = 0, blended = 0;
  const auto add_motion_until = [&](std::size_t picture) {
    while (with_motion <= picture && next_motion < groups_.size()) {
      with_motion += groups_[next_motion].states.size();
      out.emplace_back(PacketType::kMotion, std::move(groups_[next_motion++].payload));
    }
  };
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (; next_pattern < arrived[g]; ++next_pattern) {
      SequencePattern& p = (*coded)[next_pattern];
      if (p.picture != 0) add_motion_until(p.picture);
      auto payload = encode_pattern({static_cast<std::int32_t>(next_pattern), static_cast<std::int32_t>(p.picture),
                                     p.picture == 0 ? seen : CodedState{}, std::move(p.av1)},
                                    scene.setup);
      if (!payload) return fail(payload.error());
      out.emplace_back(PacketType::kPattern, std::move(*payload));
    }
    const std::size_t end = blended + groups_[g].states.size();
    add_motion_until(end - 1);
    BlendGroup group;
    group.key = blend.needs_key();
    group.modes.assign(modes->begin() + blended, modes->begin() + end);
    auto payload = blend.encode(group);
    if (!payload) return fail(payload.error());
    out.emplace_back(PacketType::kBlend, std::move(*payload));
    blended = end;
  }
  return out;
}

}  // namespace fbs
