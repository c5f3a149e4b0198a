#include "encoder/pattern_pass.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "bitstream/payload/pattern_payload.h"
#include "encoder/patterns/pattern_trial.h"
#include "encoder/patterns/pattern_size.h"

namespace fbs {
namespace {

/// A segment ends after so many seconds at most: what is not yet coded is on disk, and its end is a delay.
constexpr double kSegmentSeconds = 40;

/// Patterns are kept as long as they take less memory than this, bytes.
constexpr double kStoreBytes = 256e6;

// For deciding how many patterns: libaom's speed, pictures coded, and every so many drawn.
constexpr int kTrialSpeed = 6;
constexpr std::size_t kTrialPictures = 4, kLossEvery = 5;

double fps_of(const VideoFormat& format) {
  return static_cast<double>(format.frame_rate.num) / format.frame_rate.den;
}

}  // namespace

PatternPass::PatternPass(const VideoFormat& format, const PatternPassSettings& settings)
    : format_(format), settings_(settings) {
  const double bytes = 1.5 * format.width * format.height;
  store_ = static_cast<std::int32_t>(std::clamp(kStoreBytes / bytes, 4.0, double{kMaxPatterns}));
}

void PatternPass::add(std::span<const State> states, std::vector<std::uint8_t> payload) {
  segment_.groups.push_back({states.size(), std::move(payload)});
  for (State s : states) {
    s.picture = picture_ + static_cast<std::int32_t>(segment_.states.size());
    segment_.states.push_back(s);
  }
}

bool PatternPass::segment_ends() const {
  if (settings_.count > 0) return false;
  const double seconds = std::min(kSegmentSeconds, (store_ - 1) / settings_.point.per_second);
  return static_cast<double>(segment_.states.size()) >= std::max(1.0, seconds * fps_of(format_));
}

Result<PatternPass::Draft> PatternPass::draft_of(const Scene& scene, std::size_t count) {
  Draft draft;
  draft.times = regular_times(segment_.states.size(), count);
  for (const std::size_t time : draft.times) {
    auto source = segment_.pictures.read(time);
    if (!source) return fail(source.error());
    draft.pictures.push_back(std::move(*source));
  }
  // Before anything is coded, patterns are taken to come in display order and without loss.
  for (std::size_t k = 0; k < draft.times.size(); ++k) draft.coded.push_back({k, {}, draft.pictures[k]});
  place(scene, draft);
  return draft;
}

void PatternPass::place(const Scene& scene, Draft& draft) const {
  draft.shown.clear();
  draft.patterns = scene.patterns;
  if (picture_ == 0) draft.patterns.clear();
  for (SequencePattern& p : draft.coded) {
    const std::size_t time = draft.times[p.picture];
    draft.shown.push_back(time);
    const State& seen = picture_ + time == 0 ? scene.patterns.front().seen : segment_.states[time];
    draft.patterns.push_back(make_pattern(std::move(p.decoded), seen, scene.geometry));
  }
  draft.arrived = arrivals(segment_, draft.shown, picture_ == 0);
}

SegmentPatterns PatternPass::usable(const Scene& scene, const Draft& draft) const {
  SegmentPatterns out{{*scene.geometry, scene.setup.mouth, draft.patterns}, {}};
  const std::size_t old = draft.patterns.size() - draft.coded.size();
  for (const std::size_t arrived : draft.arrived) {
    // In the order of the decoder's slots: each new pattern takes the place of the old one in its slot.
    AvailablePatterns available(std::max(old, arrived));
    for (std::size_t slot = 0; slot < available.size(); ++slot)
      available[slot] = slot < arrived ? old + slot : slot;
    out.available.push_back(std::move(available));
  }
  return out;
}

Result<double> PatternPass::loss_between(const Scene& scene, std::size_t count) {
  const auto draft = draft_of(scene, count);
  if (!draft) return fail(draft.error());
  return blend_loss(segment_, usable(scene, *draft), kLossEvery);
}

Result<std::size_t> PatternPass::decide(const Scene& scene) {
  const std::size_t pictures = segment_.states.size();
  const double seconds = static_cast<double>(pictures) / fps_of(format_);
  const std::size_t most = std::min<std::size_t>(store_, pictures);
  const auto wanted = settings_.count > 0 ? settings_.count : std::lround(settings_.point.per_second * seconds);
  const auto usual = std::clamp<std::size_t>(wanted, 2, std::max<std::size_t>(most, 2));
  if (most < kTrialPictures || usual < kTrialPictures) return std::min(usual, most);
  const auto loss = loss_between(scene, usual);
  if (!loss) return fail(loss.error());
  // A few neighbours from the middle of the segment.
  const std::vector<std::size_t> times = regular_times(pictures, usual);
  std::vector<Picture> some;
  for (std::size_t k = 0; k < std::min(kTrialPictures, times.size()); ++k) {
    auto picture = segment_.pictures.read(times[(times.size() - kTrialPictures) / 2 + k]);
    if (!picture) return fail(picture.error());
    some.push_back(std::move(*picture));
  }
  double motion = 0;
  for (const Segment::Group& g : segment_.groups) motion += static_cast<double>(g.payload.size());
  SequenceSettings trial = settings_.coding;
  trial.speed = kTrialSpeed;
  trial.reduced = false;
  const auto full = trial_cost(format_, some, trial);
  if (!full) return fail(full.error());
  trial.reduced = true;
  const auto reduced = trial_cost(format_, some, trial);
  if (!reduced) return fail(reduced.error());
  settings_.coding.reduced = std::getenv("FBS_RED") ? std::atoi(std::getenv("FBS_RED")) : reduced_size_pays(*loss, usual, motion, *full, *reduced);
  return usual;
}

Result<void> PatternPass::choose(const Scene& scene, const Draft& draft) {
  const auto modes = choose_modes(segment_, usable(scene, draft), settings_.lambda);
  if (!modes) return fail(modes.error());
  for (std::size_t t = 0; t < modes->size(); ++t) segment_.states[t].blend = (*modes)[t];
  return {};
}

Result<void> PatternPass::solve(const Scene& scene, Draft& draft) {
  auto solved = solve_patterns(segment_, usable(scene, draft), draft.coded.size(), SolverSettings{});
  if (!solved) return fail(solved.error());
  for (std::size_t k = 0; k < solved->size(); ++k) draft.pictures[draft.coded[k].picture] = std::move((*solved)[k]);
  return {};
}

Result<void> PatternPass::code(const Scene& scene, Draft& draft, int speed) {
  SequenceSettings coding = settings_.coding;
  coding.speed = speed;
  auto coded = code_pattern_sequence(format_, draft.pictures, coding);
  if (!coded) return fail(coded.error());
  draft.coded = std::move(*coded);
  place(scene, draft);
  return {};
}

Result<std::vector<TypedPayload>> PatternPass::packets(Scene& scene, const CodedState& rest, Draft& draft) {
  std::vector<std::vector<std::uint8_t>> patterns, blends;
  for (std::size_t k = 0; k < draft.coded.size(); ++k) {
    const std::int32_t picture = picture_ + static_cast<std::int32_t>(draft.shown[k]);
    auto payload = encode_pattern({static_cast<std::int32_t>(k), picture, picture == 0 ? rest : CodedState{},
                                   std::move(draft.coded[k].av1)},
                                  scene.setup);
    if (!payload) return fail(payload.error());
    patterns.push_back(std::move(*payload));
  }
  std::size_t t = 0;
  for (const Segment::Group& g : segment_.groups) {
    BlendGroup group;
    group.key = blend_.needs_key();
    for (const std::size_t end = t + g.pictures; t < end; ++t) group.modes.push_back(segment_.states[t].blend);
    auto payload = blend_.encode(group);
    if (!payload) return fail(payload.error());
    blends.push_back(std::move(*payload));
  }
  // The decoder's slots after the segment.
  const std::size_t old = draft.patterns.size() - draft.coded.size();
  if (picture_ == 0) scene.patterns.clear();
  for (std::size_t k = 0; k < draft.coded.size(); ++k) {
    if (k < scene.patterns.size())
      scene.patterns[k] = std::move(draft.patterns[old + k]);
    else
      scene.patterns.push_back(std::move(draft.patterns[old + k]));
  }
  picture_ += static_cast<std::int32_t>(segment_.states.size());
  return in_stream_order(std::exchange(segment_, {}), draft.shown, draft.arrived, std::move(patterns),
                         std::move(blends));
}

Result<std::vector<TypedPayload>> PatternPass::end_segment(Scene& scene, const CodedState& rest) {
  if (segment_.states.empty()) return std::vector<TypedPayload>{};
  const auto count = decide(scene);
  if (!count) return fail(count.error());
  auto draft = draft_of(scene, *count);
  if (!draft) return fail(draft.error());
  if (settings_.rounds > 0) {
    // Modes are chosen for patterns with coding errors: chosen for lossless ones they gain 5 % less.
    if (auto coded = code(scene, *draft, kTrialSpeed); !coded) return fail(coded.error());
    if (auto chosen = choose(scene, *draft); !chosen) return fail(chosen.error());
  }
  for (int round = 0; round < std::max(settings_.rounds, 1); ++round) {
    if (settings_.rounds > 0)
      if (auto solved = solve(scene, *draft); !solved) return fail(solved.error());
    if (auto coded = code(scene, *draft, settings_.coding.speed); !coded) return fail(coded.error());
    if (auto chosen = choose(scene, *draft); !chosen) return fail(chosen.error());
  }
  return packets(scene, rest, *draft);
}

}  // namespace fbs
