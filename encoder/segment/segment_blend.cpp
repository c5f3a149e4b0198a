#include "encoder/segment/segment_blend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "encoder/blend/mode_choice.h"

namespace fbs {
namespace {

// Sizes for comparing blends and for solving, pixels: larger ones cost time and gain little.
constexpr int kCompareWidth = 240, kSolveWidth = 260;

/// Interval of the pictures used in solving for patterns.
constexpr std::size_t kSolveEvery = 2;

/// Memory limit of solving, bytes: large pictures use fewer of them.
constexpr std::size_t kSolverBytes = 30e6;

/// Patterns that are solved for together, at most.
constexpr std::size_t kSolvedTogether = 16;

/// log2 of the reduction that makes a picture no wider than `width`, but leaves the two rows that are needed
/// to interpolate.
int reduction_to(int width, const Picture& picture) {
  int reduction = 0;
  while ((picture.width() >> reduction) > width && picture.height() >> (reduction + 1) > 1) ++reduction;
  return reduction;
}

/// The group of each picture.
std::vector<std::size_t> groups_of(const Segment& segment) {
  std::vector<std::size_t> out;
  for (std::size_t g = 0; g < segment.groups.size(); ++g)
    out.insert(out.end(), segment.groups[g].pictures, g);
  return out;
}

/// Calls use(k, number, picture, available patterns) for some pictures of the segment, by workers.
/// @param numbers  k counts them
template <class Use>
Result<void> for_each_picture(const Segment& segment, const SegmentPatterns& patterns,
                              std::span<const std::size_t> numbers, Workers& workers, Use&& use) {
  const std::vector<std::size_t> group = groups_of(segment);
  std::vector<Result<void>> done(numbers.size());
  workers.run(static_cast<int>(numbers.size()), [&](int k, int) {
    const std::size_t number = numbers[k];
    const auto picture = segment.pictures.read(number);
    if (picture)
      use(k, number, *picture, patterns.available[group[number]]);
    else
      done[k] = fail(picture.error());
  });
  for (auto& result : done)
    if (!result) return result;
  return {};
}

/// Numbers of the segment's pictures at an interval.
std::vector<std::size_t> every_so_many(const Segment& segment, std::size_t every) {
  std::vector<std::size_t> out;
  for (std::size_t t = 0; t < segment.states.size(); t += every) out.push_back(t);
  return out;
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

/// Adds a change at reduced size to the plane at full size.
void add_change(const ReducedPlane& change, int reduction, Plane& plane) {
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

void add_change(const SolvedPlanes& change, const PlaneGroup& group, Picture& picture) {
  for (std::size_t lane = 0; lane < group.planes.size(); ++lane) {
    const std::size_t p = group.planes[lane];
    add_change(change.plane(static_cast<int>(lane)), group.plane_reduction(p),
               picture.*PlaneGroup::member(p));
  }
}

/// Divides patterns into rows of neighbours in time that are solved for together.
/// @param first  of the patterns to solve for
std::vector<std::vector<std::size_t>> solved_together(const PatternList& patterns, std::size_t first) {
  std::vector<std::size_t> all;
  for (std::size_t k = first; k < patterns.size(); ++k) all.push_back(k);
  std::sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
    return patterns[a].seen.picture < patterns[b].seen.picture;
  });
  std::vector<std::vector<std::size_t>> out;
  const std::size_t rows = (all.size() + kSolvedTogether - 1) / kSolvedTogether;
  for (std::size_t r = 0; r < rows; ++r)
    out.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(r * all.size() / rows),
                     all.begin() + static_cast<std::ptrdiff_t>((r + 1) * all.size() / rows));
  return out;
}

/// Whether a pattern of these has a weight in the picture.
bool shows(const PatternList& patterns, const AvailablePatterns& available, const State& picture,
           std::span<const std::size_t> any) {
  std::vector<const State*> seen;
  for (const std::size_t k : available) seen.push_back(&patterns[k].seen);
  for (const RegionBlend& region : blend_picture(seen, picture))
    for (const WeightedSource& s : region)
      if (std::find(any.begin(), any.end(), available[s.source.pattern]) != any.end()) return true;
  return false;
}

/// The least squares problem of some patterns in a group of planes.
class GroupProblem {
 public:
  /// @param workers  must outlive the object, as all else
  GroupProblem(const Segment& segment, const SegmentPatterns& patterns, const PlaneGroup& group,
               Workers& workers)
      : segment_(segment),
        patterns_(patterns),
        group_(group),
        groups_(groups_of(segment)),
        workers_(workers) {}

  /// @param now  pictures of the patterns; those of `free` become the solution
  Result<void> solve(std::span<const std::size_t> free, const SolverSettings& settings,
                     std::vector<Picture>& now) const {
    PatternSolver solver(patterns_.scene, group_.reduction, group_.planes);
    const std::vector<std::size_t> used = pictures_of(free, solver);
    PatternPlanes sources;
    for (std::size_t k = 0; k < now.size(); ++k) {
      const bool needed = solver.uses(k) || std::ranges::find(free, k) != free.end();
      sources.push_back(needed ? group_.of(now[k]) : SolvedPlanes());
    }
    const auto target = [&](std::size_t k) -> Result<SolvedPlanes> {
      const auto picture = segment_.pictures.read(used[k]);
      if (!picture) return fail(picture.error());
      return group_.of(*picture);
    };
    const auto change = solver.solve(target, std::move(sources), free, settings, workers_);
    if (!change) return fail(change.error());
    workers_.run(static_cast<int>(free.size()),
                 [&](int f, int) { add_change((*change)[f], group_, now[free[f]]); });
    return {};
  }

 private:
  void set(PatternSolver& solver, std::size_t number, std::size_t picture) const {
    const Picture& any = patterns_.scene.patterns.front().picture;
    solver.set_picture(number, segment_.states[picture], available(picture), {any.width(), any.height()});
  }
  [[nodiscard]] const AvailablePatterns& available(std::size_t picture) const {
    return patterns_.available[groups_[picture]];
  }

  /// Numbers of the segment's pictures that the solver uses, which it gets.
  [[nodiscard]] std::vector<std::size_t> pictures_of(std::span<const std::size_t> free,
                                                     PatternSolver& solver) const {
    std::vector<std::size_t> showing;
    for (const std::size_t t : every_so_many(segment_, kSolveEvery))
      if (shows(patterns_.scene.patterns, available(t), segment_.states[t], free)) showing.push_back(t);
    std::vector<std::size_t> used;
    if (!showing.empty()) {
      solver.resize(1);
      set(solver, 0, showing[showing.size() / 2]);
      const std::size_t every = (showing.size() * solver.bytes() + kSolverBytes - 1) / kSolverBytes;
      for (std::size_t k = 0; k < showing.size(); k += std::max<std::size_t>(every, 1))
        used.push_back(showing[k]);
    }
    solver.resize(used.size());
    workers_.run(static_cast<int>(used.size()), [&](int k, int) { set(solver, k, used[k]); });
    return used;
  }

  const Segment& segment_;
  const SegmentPatterns& patterns_;
  const PlaneGroup& group_;
  std::vector<std::size_t> groups_;  ///< of the pictures
  Workers& workers_;
};

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

Result<SegmentErrors> mode_errors(const Segment& segment, const SegmentPatterns& patterns, std::size_t most,
                                  Workers& workers) {
  const Picture& any = patterns.scene.patterns.front().picture;
  const BlendErrors blend(patterns.scene, reduction_to(kCompareWidth, any));
  SegmentErrors out;
  std::vector<std::size_t> first;  // of each run
  for (std::size_t t = 0; t < segment.states.size(); ++t) {
    if (t == 0 || out.runs.back().pictures == most || segment.is_cut(t)) {
      out.runs.push_back({});
      first.push_back(t);
    }
    ++out.runs.back().pictures;
  }
  const auto done = for_each_picture(
      segment, patterns, first, workers,
      [&](std::size_t k, std::size_t t, const Picture& picture, const AvailablePatterns& available) {
        out.runs[k].errors = blend.errors(picture.y, segment.states[t], available);
      });
  if (!done) return fail(done.error());
  return out;
}

Result<double> blend_loss(const Segment& segment, const SegmentPatterns& patterns, std::size_t every,
                          Workers& workers) {
  const Picture& any = patterns.scene.patterns.front().picture;
  const BlendErrors blend(patterns.scene, reduction_to(kCompareWidth, any));
  const std::vector<std::size_t> some = every_so_many(segment, every);
  std::vector<double> loss(some.size());
  const auto done = for_each_picture(
      segment, patterns, some, workers,
      [&](std::size_t k, std::size_t t, const Picture& picture, const AvailablePatterns& available) {
        for (const auto& region : blend.errors(picture.y, segment.states[t], available))
          loss[k] += *std::min_element(region.begin(), region.end());
      });
  if (!done) return fail(done.error());
  return std::accumulate(loss.begin(), loss.end(), 0.0) /
         static_cast<double>(some.size() * any.y.samples.size());
}

Result<std::vector<Picture>> solve_patterns(const Segment& segment, const SegmentPatterns& patterns,
                                            std::size_t count, const SolverSettings& settings,
                                            Workers& workers) {
  const PatternList& all = patterns.scene.patterns;
  const std::size_t old = all.size() - count;
  const std::int32_t first = segment.states.front().picture;
  std::vector<Picture> out;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k < old) {
      out.push_back(all[k].picture);
      continue;
    }
    const auto source = segment.pictures.read(all[k].seen.picture - first);
    if (!source) return fail(source.error());
    out.push_back(*source);
  }
  for (const PlaneGroup& group : plane_groups(reduction_to(kSolveWidth, all.front().picture))) {
    const GroupProblem problem(segment, patterns, group, workers);
    for (const auto& free : solved_together(all, old))
      if (auto solved = problem.solve(free, settings, out); !solved) return fail(solved.error());
  }
  out.erase(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(old));
  return out;
}

}  // namespace fbs
