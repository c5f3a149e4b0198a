#include "encoder/segment_blend.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "encoder/blend/mode_choice.h"

namespace fbs {
namespace {

// Sizes at which blends are compared and patterns solved for, pixels: larger ones cost time and gain little.
constexpr int kCompareWidth = 240, kSolveWidth = 400;

/// Fewer of a long segment or of large pictures are solved for, so that they take no more memory than this,
/// bytes.
constexpr std::size_t kSolverBytes = 400e6;

/// log2 of the reduction that makes a picture no wider than `width`, but leaves the two rows that are needed
/// to interpolate.
int reduction_to(int width, const Picture& picture) {
  int reduction = 0;
  while ((picture.width() >> reduction) > width && picture.height() >> (reduction + 1) > 1) ++reduction;
  return reduction;
}

/// Calls use(number in the segment, picture, available patterns) for every so many pictures.
template <class Use>
Result<void> for_each_picture(Segment& segment, const SegmentPatterns& patterns, std::size_t every,
                              Use&& use) {
  std::size_t t = 0;
  for (std::size_t g = 0; g < segment.groups.size(); ++g) {
    for (std::size_t i = 0; i < segment.groups[g].pictures; ++i, ++t) {
      if (t % every != 0) continue;
      const auto picture = segment.pictures.read(t);
      if (!picture) return fail(picture.error());
      use(t, *picture, patterns.available[g]);
    }
  }
  return {};
}

/// Every so many pictures of the segment are solved for.
std::size_t solve_every(const Segment& segment, const SegmentPatterns& patterns, glm::ivec2 size,
                        int luma_reduction, int chroma_reduction) {
  const std::size_t pictures = segment.states.size();
  const auto bytes_at = [&](int reduction) {
    PatternSolver one(patterns.scene, reduction);
    one.add_picture(segment.states[pictures / 2], patterns.available.back(), size);
    return one.bytes();
  };
  std::size_t bytes = bytes_at(luma_reduction);
  if (chroma_reduction != luma_reduction) bytes += bytes_at(chroma_reduction);
  return std::max(kSolveEvery, (pictures * bytes + kSolverBytes - 1) / kSolverBytes);
}

/// Adds what `now` has over `before`, planes at a reduced size, to a plane at full size.
void add_change(const ReducedPlane& now, ReducedPlane before, int reduction, Plane& plane) {
  for (std::size_t i = 0; i < before.samples.size(); ++i)
    before.samples[i] = now.samples[i] - before.samples[i];
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

/// The planes of a picture as they are solved for, and at which reduction of their own samples.
struct SolvedPlane {
  Plane Picture::*plane;
  int reduction;
};

}  // namespace

Result<std::vector<RegionModes>> choose_modes(Segment& segment, const SegmentPatterns& patterns,
                                              double lambda, std::size_t every) {
  const Picture& any = patterns.scene.patterns.front().picture;
  const BlendErrors blend(patterns.scene, reduction_to(kCompareWidth, any));
  std::vector<ModeErrors> errors;
  const auto done =
      for_each_picture(segment, patterns, every,
                       [&](std::size_t t, const Picture& picture, const AvailablePatterns& available) {
                         errors.push_back(blend.errors(picture.y, segment.states[t], available));
                       });
  if (!done) return fail(done.error());
  const std::vector<RegionModes> chosen = choose_modes(errors, lambda / static_cast<double>(every));
  std::vector<RegionModes> out;
  for (std::size_t t = 0; t < segment.states.size(); ++t) out.push_back(chosen[t / every]);
  return out;
}

Result<double> blend_loss(Segment& segment, const SegmentPatterns& patterns, std::size_t every) {
  const Picture& any = patterns.scene.patterns.front().picture;
  const BlendErrors blend(patterns.scene, reduction_to(kCompareWidth, any));
  double sum = 0, samples = 0;
  const auto done =
      for_each_picture(segment, patterns, every,
                       [&](std::size_t t, const Picture& picture, const AvailablePatterns& available) {
                         const ModeErrors errors = blend.errors(picture.y, segment.states[t], available);
                         for (const auto& region : errors)
                           sum += *std::min_element(region.begin(), region.end());
                         samples += static_cast<double>(picture.y.samples.size());
                       });
  if (!done) return fail(done.error());
  return sum / samples;
}

Result<std::vector<Picture>> solve_patterns(Segment& segment, const SegmentPatterns& patterns,
                                            std::size_t count, const SolverSettings& settings) {
  const std::span<const Pattern> all = patterns.scene.patterns;
  const glm::ivec2 size(all.front().picture.width(), all.front().picture.height());
  const int luma_reduction = reduction_to(kSolveWidth, all.front().picture);
  const int chroma_reduction = std::max(luma_reduction, 1);
  const std::array<SolvedPlane, 3> planes = {{{&Picture::y, luma_reduction},
                                              {&Picture::u, chroma_reduction - 1},
                                              {&Picture::v, chroma_reduction - 1}}};
  PatternSolver luma(patterns.scene, luma_reduction), chroma(patterns.scene, chroma_reduction);
  std::array<std::vector<ReducedPlane>, 3> targets;
  const std::size_t every = solve_every(segment, patterns, size, luma_reduction, chroma_reduction);
  const auto done =
      for_each_picture(segment, patterns, every,
                       [&](std::size_t t, const Picture& picture, const AvailablePatterns& available) {
                         luma.add_picture(segment.states[t], available, size);
                         if (chroma_reduction != luma_reduction)
                           chroma.add_picture(segment.states[t], available, size);
                         for (std::size_t i = 0; i < 3; ++i)
                           targets[i].push_back(reduce(picture.*planes[i].plane, planes[i].reduction));
                       });
  if (!done) return fail(done.error());

  std::vector<Picture> out;
  const std::int32_t first = segment.states.front().picture;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool free = k + count >= all.size();
    auto picture =
        free ? segment.pictures.read(all[k].seen.picture - first) : Result<Picture>(all[k].picture);
    if (!picture) return fail(picture.error());
    out.push_back(std::move(*picture));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    PatternPlanes anchors;
    for (const Picture& p : out) anchors.push_back(reduce(p.*planes[i].plane, planes[i].reduction));
    const PatternSolver& solver = i == 0 || chroma_reduction == luma_reduction ? luma : chroma;
    const PatternPlanes solved = solver.solve(targets[i], anchors, count, i, settings);
    for (std::size_t k = out.size() - count; k < out.size(); ++k)
      add_change(solved[k], anchors[k], planes[i].reduction, out[k].*planes[i].plane);
  }
  out.erase(out.begin(), out.end() - static_cast<std::ptrdiff_t>(count));
  return out;
}

}  // namespace fbs
