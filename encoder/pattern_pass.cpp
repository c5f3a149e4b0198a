#include "encoder/pattern_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
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

// Sizes at which blends are compared and patterns solved for, pixels: larger ones cost time and gain little.
constexpr int kCompareWidth = 240, kSolveWidth = 400;

/// Every so many pictures count when patterns are solved for.
constexpr std::size_t kSolveEvery = 3;

/// log2 of the reduction that makes a picture no wider than `width`.
int reduction_to(int width, const VideoFormat& format) {
  int reduction = 0;
  while ((format.width >> reduction) > width) ++reduction;
  return reduction;
}

/// Adds what `now` has over `before`, planes at a reduced size, to a plane at full size.
void add_change(const ReducedPlane& now, ReducedPlane before, int reduction, Plane& plane) {
  for (std::size_t i = 0; i < before.samples.size(); ++i) before.samples[i] = now.samples[i] - before.samples[i];
  const float scale = 1.0F / static_cast<float>(1 << reduction);
  for (int y = 0; y < plane.height; ++y) {
    const float v = (static_cast<float>(y) + 0.5F) * scale - 0.5F;
    std::uint8_t* row = plane.row(y);
    for (int x = 0; x < plane.width; ++x) {
      const float u = (static_cast<float>(x) + 0.5F) * scale - 0.5F;
      row[x] = static_cast<std::uint8_t>(
          std::clamp(std::lround(static_cast<float>(row[x]) + bilinear(before, u, v)), 0L, 255L));
    }
  }
}

}  // namespace

void PatternPass::add(std::vector<State> states, std::vector<std::uint8_t> payload) {
  groups_.push_back({std::move(states), std::move(payload)});
}

Result<std::vector<SequencePattern>> PatternPass::code_patterns(std::span<const Picture> pictures,
                                                                std::span<const std::size_t> times) {
  auto coded = code_pattern_sequence(format_, pictures, settings_.coding);
  if (!coded) return fail(coded.error());
  for (SequencePattern& p : *coded) p.picture = times[p.picture];
  return coded;
}

Result<std::vector<Picture>> PatternPass::solve(const Scene& scene, std::span<const State> states,
                                                std::span<const std::size_t> arrivals) {
  const int luma_reduction = reduction_to(kSolveWidth, format_), chroma_reduction = std::max(luma_reduction, 1);
  PatternSolver luma(scene, luma_reduction), chroma(scene, chroma_reduction);
  std::vector<std::size_t> all(scene.patterns.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::array<std::vector<ReducedPlane>, 3> targets;
  std::size_t t = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (std::size_t i = 0; i < groups_[g].states.size(); ++i, ++t) {
      if (t % kSolveEvery != 0) continue;
      const auto source = pictures_.read(t);
      if (!source) return fail(source.error());
      const auto available = std::span(all).first(arrivals[g]);
      const glm::ivec2 size(format_.width, format_.height);
      luma.add_picture(states[t], available, size);
      if (chroma_reduction != luma_reduction) chroma.add_picture(states[t], available, size);
      targets[0].push_back(reduce(source->y, luma_reduction));
      targets[1].push_back(reduce(source->u, chroma_reduction - 1));
      targets[2].push_back(reduce(source->v, chroma_reduction - 1));
    }
  }
  std::vector<Picture> out;
  std::array<PatternPlanes, 3> anchors;
  for (const Pattern& p : scene.patterns) {
    auto source = pictures_.read(p.seen.picture);
    if (!source) return fail(source.error());
    anchors[0].push_back(reduce(source->y, luma_reduction));
    anchors[1].push_back(reduce(source->u, chroma_reduction - 1));
    anchors[2].push_back(reduce(source->v, chroma_reduction - 1));
    out.push_back(std::move(*source));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const PatternSolver& solver = i == 0 || chroma_reduction == luma_reduction ? luma : chroma;
    const PatternPlanes solved = solver.solve(targets[i], anchors[i], i == 0, settings_.solver);
    for (std::size_t k = 0; k < out.size(); ++k) {
      Plane& plane = i == 0 ? out[k].y : i == 1 ? out[k].u : out[k].v;
      add_change(solved[k], anchors[i][k], i == 0 ? luma_reduction : chroma_reduction - 1, plane);
    }
  }
  return out;
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
  const BlendErrors blend(scene, reduction_to(kCompareWidth, format_));
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

  std::vector<Picture> pictures;
  for (const std::size_t time : times) {
    auto source = pictures_.read(time);
    if (!source) return fail(source.error());
    pictures.push_back(std::move(*source));
  }
  const State rest = scene.patterns.front().seen;
  // Before anything is coded, patterns are taken to come in display order and without loss.
  std::vector<SequencePattern> coded;
  for (std::size_t k = 0; k < times.size(); ++k) coded.push_back({times[k], {}, pictures[k]});
  std::vector<std::size_t> arrived = arrivals(coded);
  const auto take_patterns = [&] {
    scene.patterns.clear();
    for (SequencePattern& p : coded)
      scene.patterns.push_back(
          make_pattern(std::move(p.decoded), p.picture == 0 ? rest : states[p.picture], scene.geometry));
  };
  take_patterns();
  std::vector<RegionModes> modes;
  const auto choose_again = [&]() -> Result<void> {
    auto chosen = choose(scene, states, arrived);
    if (!chosen) return fail(chosen.error());
    modes = std::move(*chosen);
    for (std::size_t t = 0; t < states.size(); ++t) states[t].blend = modes[t];
    return {};
  };
  if (settings_.rounds > 0)
    if (auto chosen = choose_again(); !chosen) return fail(chosen.error());
  for (int round = 0; round < std::max(settings_.rounds, 1); ++round) {
    if (settings_.rounds > 0) {
      auto solved = solve(scene, states, arrived);
      if (!solved) return fail(solved.error());
      for (std::size_t k = 0; k < coded.size(); ++k)
        pictures[std::lower_bound(times.begin(), times.end(), coded[k].picture) - times.begin()] =
            std::move((*solved)[k]);
    }
    auto sequence = code_patterns(pictures, times);
    if (!sequence) return fail(sequence.error());
    coded = std::move(*sequence);
    arrived = arrivals(coded);
    take_patterns();
    if (auto chosen = choose_again(); !chosen) return fail(chosen.error());
  }

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
      SequencePattern& p = coded[next_pattern];
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
    group.modes.assign(modes.begin() + blended, modes.begin() + end);
    auto payload = blend.encode(group);
    if (!payload) return fail(payload.error());
    out.emplace_back(PacketType::kBlend, std::move(*payload));
    blended = end;
  }
  return out;
}

}  // namespace fbs
