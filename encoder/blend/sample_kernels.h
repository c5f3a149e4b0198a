// Errors of a blend's sources, by vector code for each kind of processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "encoder/blend/source_samples.h"

namespace fbs {

/// Some samples of a picture, run by run.
class ShownSamples {
 public:
  /// Memory that differences() may write to beyond its samples.
  static constexpr std::size_t kLanes = 8;

  /// @param most  samples that may be added
  explicit ShownSamples(std::size_t most)
      : row_(most + kLanes), first_(row_.size()), step_(row_.size()), luma_(row_.size()) {}

  /// @param shown  the picture at the surface's size
  void add(const SurfaceRun& run, const ReducedPlane& shown);
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Luma of a source at some of the samples, less theirs; both rounded. The same on all processors.
  /// @param luma  of the source, 2x2 samples or more
  /// @param out   end - begin samples, and room for kLanes - 1
  void differences(const TriangleSource& source, const ReducedPlane& luma, std::size_t begin, std::size_t end,
                   std::int16_t* out) const;

 private:
  std::size_t size_ = 0;
  // Each with kLanes more, which are read and do not count.
  std::vector<float> row_, first_, step_;  ///< row and first sample of the run, and samples from there
  std::vector<std::int16_t> luma_;
};

/// Sum of the products of errors of -255..255.
/// @param b  as many as `a`
[[nodiscard]] std::int64_t error_product(std::span<const std::int16_t> a, std::span<const std::int16_t> b);

}  // namespace fbs
