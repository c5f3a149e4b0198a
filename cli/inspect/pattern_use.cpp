#include "cli/inspect/pattern_use.h"

#include "cli/stream/picture_sources.h"
#include "decoder/blend/picture_blend.h"

namespace fbs::cli {

void PatternUse::add_picture() {
  const PictureSources sources = picture_sources(decoder_);
  weights_.resize(sources.arrived);
  for (std::size_t r = 0; r < kRegionCount; ++r) {
    if (sources.regions[r].empty()) continue;
    ++pictures_[r];
    for (const PatternWeight& w : sources.regions[r]) weights_[w.number][r] += w.weight;
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
  const std::uint64_t picture = decoder_.pattern_records()[pattern].picture - decoder_.start().pictures;
  return picture < times_.size() ? times_[picture] : end_;
}

}  // namespace fbs::cli
