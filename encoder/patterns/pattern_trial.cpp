#include "encoder/patterns/pattern_trial.h"

namespace fbs {

Result<PatternCost> trial_cost(const VideoFormat& format, std::span<const Picture> pictures,
                               const SequenceSettings& settings) {
  const auto coded = code_pattern_sequence(format, pictures, settings);
  if (!coded) return fail(coded.error());
  PatternCost out;
  double samples = 0;
  for (const SequencePattern& p : *coded) {
    const auto bytes = static_cast<double>(p.av1.size());
    if (p.picture == 0)
      out.first_bytes = bytes;
    else
      out.later_bytes += bytes / static_cast<double>(coded->size() - 1);
    const Plane& source = pictures[p.picture].y;
    for (std::size_t i = 0; i < source.samples.size(); ++i) {
      const int d = source.samples[i] - p.decoded.y.samples[i];
      out.squared_error += d * d;
    }
    samples += static_cast<double>(source.samples.size());
  }
  out.squared_error /= samples;
  return out;
}

}  // namespace fbs
