#include "encoder/segment/segment_draft.h"

#include <numeric>
#include <utility>

namespace fbs {
namespace {

/// The pattern as the decoder makes it; from the source picture if it is not coded yet.
Pattern pattern_of(const SegmentStore& store, const Scene& scene, const SequencePattern& p,
                   std::size_t time) {
  const State& seen = store.seen_state(scene, time);
  return p.av1.empty() ? make_pattern(p.decoded, seen, scene.geometry)
                       : make_coded_pattern(p.decoded, seen, scene.geometry, scene.setup);
}

}  // namespace

Result<SegmentDraft> SegmentDraft::of_sources(const SegmentStore& store, std::vector<std::size_t> times,
                                              std::size_t first_slot) {
  SegmentDraft draft;
  draft.times = std::move(times);
  draft.first_slot = first_slot;
  for (const std::size_t time : draft.times) {
    auto source = store.segment().pictures.read(time);
    if (!source) return fail(source.error());
    draft.pictures.push_back(*source);
  }
  return draft;
}

std::vector<Picture> SegmentDraft::to_code(const SegmentStore& store, const Scene& scene,
                                           Workers& workers) const {
  std::vector<Picture> out = pictures;
  workers.run(static_cast<int>(out.size()),
              [&](int k, int) { store.reduce_contrast(scene, times[k], out[k]); });
  return out;
}

Result<void> SegmentDraft::code(const SegmentStore& store, const Scene& scene, const SequenceSettings& coding,
                                Workers& workers) {
  const std::vector<Picture> all = to_code(store, scene, workers);
  const std::size_t before = start ? 1 : 0;
  auto sequence = code_pattern_sequence(store.format(), std::span(all).subspan(before), coding);
  if (!sequence) return fail(sequence.error());
  for (SequencePattern& p : *sequence) p.picture += before;
  if (start) sequence->insert(sequence->begin(), *start);
  take(store, scene, std::move(*sequence));
  return {};
}

void SegmentDraft::take_sources(const SegmentStore& store, const Scene& scene) {
  std::vector<SequencePattern> sources;
  for (std::size_t k = 0; k < pictures.size(); ++k) sources.push_back({k, {}, pictures[k]});
  take(store, scene, std::move(sources));
}

void SegmentDraft::take(const SegmentStore& store, const Scene& scene,
                        std::vector<SequencePattern> patterns_coded) {
  coded = std::move(patterns_coded);
  place(store, scene);
}

void SegmentDraft::place(const SegmentStore& store, const Scene& scene) {
  shown.clear();
  patterns = scene.patterns;
  if (store.is_first()) patterns.clear();
  for (const SequencePattern& p : coded) {
    shown.push_back(times[p.picture]);
    patterns.push_back(pattern_of(store, scene, p, times[p.picture]));
  }
  arrived = arrivals(store.segment(), shown, store.is_first());
}

SegmentPatterns SegmentDraft::usable(const Scene& scene) const {
  SegmentPatterns out{{*scene.geometry, scene.setup.mouth, patterns}, {}};
  const std::size_t old = patterns.size() - coded.size();
  const auto slots = static_cast<std::size_t>(scene.setup.patterns);
  for (const std::size_t sent : arrived) {
    // In the order of the decoder's slots: each new pattern replaces the old one in its slot.
    AvailablePatterns available(old);
    std::iota(available.begin(), available.end(), std::size_t{0});
    for (std::size_t k = 0; k < sent; ++k) {
      const std::size_t place = slot(k, slots);
      if (place == available.size())
        available.push_back(old + k);
      else
        available[place] = old + k;
    }
    out.available.push_back(std::move(available));
  }
  return out;
}

Result<void> SegmentDraft::solve(const SegmentStore& store, const Scene& scene,
                                 const SolverSettings& settings, Workers& workers) {
  auto solved = solve_patterns(store.segment(), usable(scene), coded.size(), settings, workers);
  if (!solved) return fail(solved.error());
  for (std::size_t k = 0; k < solved->size(); ++k) pictures[coded[k].picture] = std::move((*solved)[k]);
  return {};
}

Result<std::vector<TypedPayload>> SegmentDraft::packets(const SegmentStore& store, const Setup& setup,
                                                        SegmentStore::Coders& coders) const {
  std::vector<PatternSyntax> syntax;
  std::vector<std::size_t> bytes;
  for (std::size_t k = 0; k < coded.size(); ++k) {
    syntax.push_back(store.pattern_syntax(slot(k, store.slots()), shown[k], coded[k].av1));
    syntax.back().alone = alone && store.number_of(shown[k]) > 0;
    bytes.push_back(syntax.back().alone ? kMaxPatternsTogether : syntax.back().av1.size());
  }
  std::vector<TypedPayload> out;
  std::size_t moved = 0, drawn = 0;
  const std::vector<PlannedPacket> planned = in_stream_order(store.segment(), shown, arrived, bytes);
  for (auto p = planned.begin(); p != planned.end(); ++p) {
    if (p->type == PacketType::kPattern) {
      auto payload = coders.patterns.encode(std::span(syntax).subspan(p->first, p->count), setup,
                                            store.number_of(moved));
      if (!payload) return fail(payload.error());
      out.emplace_back(PacketType::kPattern, std::move(*payload));
      continue;
    }
    const Segment::Group& group = store.segment().groups[p->first];
    const bool moves = p->type == PacketType::kMotion;
    if (moves) moved += group.pictures;
    // Motion and blend of a group are a unit where nothing comes between them.
    const auto next = p + 1;
    const bool unit =
        moves && next != planned.end() && next->type == PacketType::kBlend && next->first == p->first;
    if (moves && !unit) {
      out.emplace_back(PacketType::kMotion, group.payload);
      continue;
    }
    const BlendGroup blend = store.blend_group(coders.blends, drawn, group.pictures);
    drawn += group.pictures;
    auto payload = unit ? coders.blends.encode_in_unit(blend) : coders.blends.encode(blend);
    if (!payload) return fail(payload.error());
    if (unit) {
      out.emplace_back(PacketType::kUnit, unit_payload(group.payload, *payload));
      p = next;
    } else {
      out.emplace_back(PacketType::kBlend, std::move(*payload));
    }
  }
  return out;
}

void SegmentDraft::keep(const SegmentStore& store, Scene& scene) const {
  const std::size_t old = patterns.size() - coded.size();
  if (store.is_first()) scene.patterns.clear();
  for (std::size_t k = 0; k < coded.size(); ++k) {
    Pattern pattern = patterns[old + k];
    pattern.slot = static_cast<std::int32_t>(slot(k, store.slots()));
    scene.patterns.store(std::move(pattern));
  }
}

}  // namespace fbs
