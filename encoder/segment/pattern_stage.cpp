#include "encoder/segment/pattern_stage.h"

#include <utility>

namespace fbs {
namespace {

/// A scene of so many seconds is known as well as a file. At equal rate LivePatterns shows scenes of one
/// second better than FilePatterns (by 0.5 dB in three of five clips), those of two worse in four.
constexpr double kWholeSeconds = 2;

}  // namespace

PatternStage::PatternStage(const VideoFormat& format, const PatternSettings& settings, const CodedState& rest)
    : workers_(settings.threads, settings.hooks),
      store_(format, rest, settings.groups_per_key),
      lambda_(settings.lambda) {}

PatternPolicy::PatternPolicy(PatternStage& stage)
    : stage_(stage), store_(stage.store()), workers_(stage.workers()) {}

void PatternStage::decide_by(std::unique_ptr<PatternPolicy> policy, std::unique_ptr<PatternPolicy> whole) {
  policy_ = std::move(policy);
  whole_ = std::move(whole);
}

void PatternStage::begin_scene(const CodedState& rest) {
  store_.begin_scene(rest);
  modes_ = {};
  policy_->begin_scene();
}

Result<void> PatternStage::add(const SharedPicture& picture) {
  if (auto added = store_.add(picture); !added) return added;
  (whole_ ? whole_ : policy_)->note_added(picture);
  return {};
}

Result<void> PatternStage::measure(const SegmentPatterns& patterns, std::size_t most) {
  if (!errors_.runs.empty()) return {};
  auto errors = mode_errors(store_.segment(), patterns, most, workers_);
  if (!errors) return fail(errors.error());
  errors_ = std::move(*errors);
  return {};
}

Result<void> PatternStage::choose(const Scene& scene, const SegmentDraft& draft, std::size_t most) {
  if (auto measured = measure(draft.usable(scene), most); !measured) return measured;
  store_.set_modes(errors_.cheapest_modes(lambda_, modes_));
  return {};
}

Result<SegmentDraft> PatternStage::make(const Scene& scene, SegmentDraft draft, const Making& making,
                                        const StateRefit& refit) {
  if (!draft.times.empty()) errors_ = {};
  if (making.trial) {
    // Modes are chosen for patterns with coding errors: chosen for lossless ones they gain 5 % less.
    if (auto coded = draft.code(store_, scene, *making.trial, workers_); !coded) return fail(coded.error());
    if (auto chosen = choose(scene, draft, making.draft_pictures); !chosen) return fail(chosen.error());
    if (auto solved = draft.solve(store_, scene, making.solver, workers_); !solved)
      return fail(solved.error());
    errors_ = {};
  }
  if (auto coded = making.code(draft); !coded) return fail(coded.error());
  // States are fitted last, to patterns as sent. Fitted before solving, they would compensate for what
  // solving corrects: wasted bits of motion.
  for (int i = 0; i <= making.refits; ++i) {
    if (i > 0) {
      if (auto done = refit(store_.segment(), draft.usable(scene), workers_); !done)
        return fail(done.error());
      errors_ = {};
      draft.place(store_, scene);  // patterns depend on their seen states
    }
    const std::size_t most = i < making.refits ? making.draft_pictures : making.pictures;
    if (auto chosen = choose(scene, draft, most); !chosen) return fail(chosen.error());
  }
  return draft;
}

Result<std::vector<TypedPayload>> PatternStage::end_segment(Scene& scene, bool last, std::size_t other_bytes,
                                                            const StateRefit& refit) {
  if (store_.segment().states.empty()) return std::vector<TypedPayload>{};
  PatternPolicy& policy =
      whole_ && last && store_.is_first() && store_.seconds() >= kWholeSeconds ? *whole_ : *policy_;
  const auto draft = policy.make_segment(scene, other_bytes, refit);
  if (!draft) return fail(draft.error());
  auto out = draft->packets(store_, scene.setup, store_.coders());
  if (!out) return out;
  draft->keep(store_, scene);
  policy.end_segment(*out);
  modes_ = store_.segment().states.back().blend;
  store_.end_segment();
  errors_ = {};
  begun_ = true;
  return out;
}

}  // namespace fbs
