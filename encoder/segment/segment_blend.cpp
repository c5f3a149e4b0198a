#include "encoder/segment/segment_blend.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "encoder/blend/mode_choice.h"

namespace fbs {
namespace {

// Sizes for comparing blends and for solving, pixels: larger ones cost time and gain little.
constexpr int kCompareWidth = 240, kSolveWidth = 260;

/// Interval of the pictures used in solving for patterns.
constexpr std::size_t kSolveEvery = 2;

/// Memory limit of solving, bytes: long segments or large pictures use fewer pictures.
constexpr std::size_t kSolverBytes = 400e6;

/// log2 of the reduction that makes a picture no wider than `width`, but leaves the two rows that are needed
/// to interpolate.
int reduction_to(int width, const Picture& picture) {
  int reduction = 0;
  while ((picture.width() >> reduction) > width && picture.height() >> (reduction + 1) > 1) ++reduction;
  return reduction;
}

/// Calls use(number in the segment, picture, available patterns) at an interval of pictures.
template <class Use>
Result<void> for_each_picture(Segment& segment, const SegmentPatterns& patterns, std::size_t every,
                              Use&& use) {
  std::size_t t = 0;
  for (std::size_t g = 0; g < segment.groups.size(); ++g) {
    for (std::size_t i = 0; i < segment.groups[g].pictures; ++i, ++t) {
      if (t % every != 0) continue;
      auto picture = segment.pictures.read(t);
      if (!picture) return fail(picture.error());
      use(t, *picture, patterns.available[g]);
    }
  }
  return {};
}

/// Planes solved for together, and their reduction from the picture's size.
struct PlaneGroup {
  std::vector<std::size_t> planes;  ///< 0..2
  int reduction;

  [[nodiscard]] static Plane Picture::*member(std::size_t plane) {
    return std::array{&Picture::y, &Picture::u, &Picture::v}[plane];
  }
  /// Reduction from the plane's own size.
  [[nodiscard]] int plane_reduction(std::size_t plane) const {
    return plane == 0 ? reduction : reduction - 1;
  }

  [[nodiscard]] SolvedPlanes of(const Picture& picture) const {
    std::vector<ReducedPlane> reduced;
    for (const std::size_t p : planes) reduced.push_back(reduce(picture.*member(p), plane_reduction(p)));
    return SolvedPlanes(reduced);
  }
};

/// Groups luma and chroma together where chroma is no smaller.
std::vector<PlaneGroup> plane_groups(int luma_reduction) {
  if (luma_reduction > 0) return {{{0, 1, 2}, luma_reduction}};
  return {{{0}, 0}, {{1, 2}, 1}};
}

/// The least squares problem of a group, and the planes of its pictures.
struct GroupProblem {
  PlaneGroup group;
  PatternSolver solver;
  std::vector<SolvedPlanes> targets;
};

/// Interval of the segment's pictures used in solving.
std::size_t solve_every(const Segment& segment, const SegmentPatterns& patterns, glm::ivec2 size,
                        std::span<const GroupProblem> problems) {
  const std::size_t pictures = segment.states.size();
  std::size_t bytes = 0;
  for (const GroupProblem& p : problems) {
    PatternSolver one(patterns.scene, p.group.reduction, p.group.planes);
    one.add_picture(segment.states[pictures / 2], patterns.available.back(), size);
    const glm::ivec2 reduced = size >> p.group.reduction;
    bytes += one.bytes() + sizeof(glm::vec4) * reduced.x * reduced.y;
  }
  return std::max(kSolveEvery, (pictures * bytes + kSolverBytes - 1) / kSolverBytes);
}

/// Adds the change of a plane at reduced size to the plane at full size.
void add_change(ReducedPlane change, const ReducedPlane& before, int reduction, Plane& plane) {
  for (std::size_t i = 0; i < change.samples.size(); ++i) change.samples[i] -= before.samples[i];
  const float scale = 1.0F / static_cast<float>(1 << reduction);
  for (int y = 0; y < plane.height; ++y) {
    const float v = (static_cast<float>(y) + 0.5F) * scale - 0.5F;
    std::uint8_t* row = plane.row(y);
    for (int x = 0; x < plane.width; ++x) {
      const float u = (static_cast<float>(x) + 0.5F) * scale - 0.5F;
      row[x] = static_cast<std::uint8_t>(
          std::clamp(std::lround(static_cast<float>(row[x]) + bilinear(change, u, v)), 0L, 255L));
    }
  }
}

void add_change(const SolvedPlanes& now, const SolvedPlanes& before, const PlaneGroup& group,
                Picture& picture) {
  for (std::size_t lane = 0; lane < group.planes.size(); ++lane) {
    const std::size_t p = group.planes[lane];
    const auto l = static_cast<int>(lane);
    add_change(now.plane(l), before.plane(l), group.plane_reduction(p), picture.*PlaneGroup::member(p));
  }
}

}  // namespace

std::vector<RegionModes> SegmentErrors::cheapest_modes(double lambda, const RegionModes& before) const {
  std::vector<ModeErrors> sums;
  for (const Run& run : runs) {
    sums.push_back(run.errors);
    for (auto& region : sums.back())
      for (auto& error : region) error *= static_cast<double>(run.pictures);
  }
  const std::vector<RegionModes> chosen = fbs::cheapest_modes(sums, lambda, before);
  std::vector<RegionModes> out;
  for (std::size_t r = 0; r < runs.size(); ++r) out.insert(out.end(), runs[r].pictures, chosen[r]);
  return out;
}

Result<SegmentErrors> mode_errors(Segment& segment, const SegmentPatterns& patterns, std::size_t most) {
  const Picture& any = patterns.scene.patterns.front().picture;
  const BlendErrors blend(patterns.scene, reduction_to(kCompareWidth, any));
  SegmentErrors out;
  const auto done = for_each_picture(
      segment, patterns, 1, [&](std::size_t t, const Picture& picture, const AvailablePatterns& available) {
        if (t == 0 || out.runs.back().pictures == most || segment.is_cut(t))
          out.runs.push_back({blend.errors(picture.y, segment.states[t], available), 0});
        ++out.runs.back().pictures;
      });
  if (!done) return fail(done.error());
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
  const PatternList& all = patterns.scene.patterns;
  const glm::ivec2 size(all.front().picture.width(), all.front().picture.height());
  std::vector<GroupProblem> problems;
  for (const PlaneGroup& g : plane_groups(reduction_to(kSolveWidth, all.front().picture)))
    problems.push_back({g, PatternSolver(patterns.scene, g.reduction, g.planes), {}});
  const auto done =
      for_each_picture(segment, patterns, solve_every(segment, patterns, size, problems),
                       [&](std::size_t t, const Picture& picture, const AvailablePatterns& available) {
                         for (GroupProblem& p : problems) {
                           p.solver.add_picture(segment.states[t], available, size);
                           p.targets.push_back(p.group.of(picture));
                         }
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
  for (const GroupProblem& p : problems) {
    PatternPlanes anchors;
    for (const Picture& picture : out) anchors.push_back(p.group.of(picture));
    const PatternPlanes solved = p.solver.solve(p.targets, anchors, count, settings);
    for (std::size_t k = out.size() - count; k < out.size(); ++k)
      add_change(solved[k], anchors[k], p.group, out[k]);
  }
  out.erase(out.begin(), out.end() - static_cast<std::ptrdiff_t>(count));
  return out;
}

}  // namespace fbs
