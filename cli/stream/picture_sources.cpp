#include "cli/stream/picture_sources.h"

#include <algorithm>
#include <tuple>

#include "decoder/blend/picture_blend.h"

namespace fbs::cli {
namespace {

std::vector<std::size_t> numbers_in_slots(const StreamDecoder& decoder) {
  const std::vector<PatternRecord>& records = decoder.pattern_records();
  std::vector<std::size_t> out;
  for (const Pattern& pattern : decoder.scene().patterns) {
    std::size_t k = records.size();
    while (k > 0 && records[k - 1].slot != pattern.slot) --k;
    out.push_back(k > 0 ? k - 1 : 0);
  }
  return out;
}

void add(std::vector<PatternWeight>& weights, const PatternWeight& added) {
  const auto same = std::find_if(weights.begin(), weights.end(), [&](const PatternWeight& w) {
    return w.number == added.number && w.still == added.still;
  });
  if (same == weights.end())
    weights.push_back(added);
  else
    same->weight += added.weight;
}

bool before(const PatternWeight& a, const PatternWeight& b) {
  return std::tie(a.number, a.still) < std::tie(b.number, b.still);
}

}  // namespace

PictureSources picture_sources(const StreamDecoder& decoder) {
  return picture_sources(decoder, decoder.state());
}

PictureSources picture_sources(const StreamDecoder& decoder, const State& state) {
  const Scene& scene = decoder.scene();
  PictureSources out;
  out.picture = decoder.position().pictures;
  out.arrived = decoder.pattern_records().size();
  out.in_slot = numbers_in_slots(decoder);
  if (scene.patterns.empty()) return out;

  std::vector<const State*> seen;
  for (const Pattern& p : scene.patterns) seen.push_back(&p.seen);
  const PictureBlend blend = blend_picture(seen, state);
  for (std::size_t r = 0; r < kRegionCount; ++r) {
    if (!scene.geometry && static_cast<Region>(r) != Region::kGround) continue;
    for (const WeightedSource& s : blend[r])
      // Without a face nothing is warped.
      add(out.regions[r], {out.in_slot[s.source.pattern], s.source.still || !scene.geometry, s.weight});
    std::sort(out.regions[r].begin(), out.regions[r].end(), before);
  }
  return out;
}

}  // namespace fbs::cli
