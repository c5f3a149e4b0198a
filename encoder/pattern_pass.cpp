#include "encoder/pattern_pass.h"

#include <algorithm>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/payload/pattern_payload.h"
#include "encoder/patterns/pattern_coder.h"

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

Result<std::vector<TypedPayload>> PatternPass::finish(Scene& scene, const CodedState& seen) {
  std::vector<State> states;
  for (const Group& g : groups_) states.insert(states.end(), g.states.begin(), g.states.end());
  for (std::size_t t = 0; t < states.size(); ++t) states[t].picture = static_cast<std::int32_t>(t);
  const std::vector<std::size_t> times = regular_times(states.size(), settings_.patterns);
  scene.setup.patterns = std::max<int>(2, static_cast<int>(times.size()));

  auto coder = PatternCoder::create(format_, settings_.quantiser);
  if (!coder) return fail(coder.error());
  struct Coded {
    std::size_t picture;
    std::vector<std::uint8_t> payload;
  };
  std::vector<Coded> patterns;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto source = pictures_.read(times[k]);
    if (!source) return fail(source.error());
    auto coded = coder->code(*source);
    if (!coded) return fail(coded.error());
    auto payload = encode_pattern({static_cast<std::int32_t>(k), static_cast<std::int32_t>(times[k]),
                                   k == 0 ? seen : CodedState{}, std::move(coded->av1)},
                                  scene.setup);
    if (!payload) return fail(payload.error());
    patterns.push_back({times[k], std::move(*payload)});
  }

  std::vector<TypedPayload> out;
  BlendEncoder blend;
  std::size_t next_pattern = 0, next_motion = 0, with_motion = 0, blended = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const std::size_t end = blended + groups_[g].states.size();
    const auto add_motion_until = [&](std::size_t picture) {
      while (with_motion <= picture && next_motion < groups_.size()) {
        with_motion += groups_[next_motion].states.size();
        out.emplace_back(PacketType::kMotion, std::move(groups_[next_motion++].payload));
      }
    };
    const auto add_pattern = [&] {
      if (patterns[next_pattern].picture != 0) add_motion_until(patterns[next_pattern].picture);
      out.emplace_back(PacketType::kPattern, std::move(patterns[next_pattern++].payload));
    };
    // The first group is shown from pattern 0 alone, so that a viewer need not wait for more.
    const auto last_needed = std::find_if(times.begin(), times.end(), [&](std::size_t t) { return t >= end; });
    const std::size_t needed = g == 0 ? 1 : std::min<std::size_t>(times.size(), last_needed - times.begin() + 1);
    while (next_pattern < needed) add_pattern();
    add_motion_until(end - 1);
    BlendGroup group;
    group.key = blend.needs_key();
    group.modes.resize(end - blended);
    auto payload = blend.encode(group);
    if (!payload) return fail(payload.error());
    out.emplace_back(PacketType::kBlend, std::move(*payload));
    blended = end;
  }
  return out;
}

}  // namespace fbs
