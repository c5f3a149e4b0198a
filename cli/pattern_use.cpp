#include "cli/pattern_use.h"

#include "decoder/blend/picture_blend.h"

namespace fbs::cli {

void PatternUse::add_picture() {
  const std::vector<PatternRecord>& records = decoder_.pattern_records();
  const Scene& scene = decoder_.scene();
  weights_.resize(records.size());
  std::vector<std::size_t> in_slot(scene.patterns.size());
  for (std::size_t k = 0; k < records.size(); ++k)
    if (static_cast<std::size_t>(records[k].slot) < in_slot.size()) in_slot[records[k].slot] = k;
  std::vector<const State*> seen;
  for (const Pattern& p : scene.patterns) seen.push_back(&p.seen);
  const PictureBlend blend = blend_picture(seen, decoder_.state());
  for (std::size_t r = 0; r < kRegionCount; ++r) {
    // Without a face all is ground.
    if (!scene.geometry && static_cast<Region>(r) != Region::kGround) continue;
    ++pictures_[r];
    for (const WeightedSource& s : blend[r]) weights_[in_slot[s.source.pattern]][r] += s.weight;
  }
  times_.push_back(end_);
  end_ += static_cast<double>(decoder_.duration()) / kTicksPerSecond;
}

double PatternUse::share(std::size_t pattern, Region region) const {
  const auto r = static_cast<std::size_t>(region);
  if (pattern >= weights_.size() || pictures_[r] == 0) return 0;
  return static_cast<double>(weights_[pattern][r]) / static_cast<double>(pictures_[r] * kBlendOne);
}

double PatternUse::seconds(std::size_t pattern) const {
  const std::uint64_t picture = decoder_.pattern_records()[pattern].picture;
  return picture < times_.size() ? times_[picture] : end_;
}

}  // namespace fbs::cli
