#include "encoder/surround_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "decoder/projection.h"
#include "encoder/pose.h"

namespace fbs {
namespace {

constexpr int kCellsAlongLongSide = 22;
constexpr double kMaxDifference =
    45;                            // grey levels; what differs more is something else that has come into view
constexpr int kSamplesAcross = 9;  // of a block, each way
constexpr int kLevels = kFollowOne + 1;
constexpr double kSmooth =
    12;                       // cost of one level between neighbours, in mean squared grey levels of a block
constexpr double kPrior = 4;  // cost of one level away from the guess by distance

double at(const Plane& p, double x, double y) {
  const double cx = std::clamp(x - 0.5, 0.0, p.width - 1.001),
               cy = std::clamp(y - 0.5, 0.0, p.height - 1.001);
  const int i = static_cast<int>(cx), j = static_cast<int>(cy);
  const double fx = cx - i, fy = cy - j;
  const std::uint8_t *a = p.row(j) + i, *b = p.row(j + 1) + i;
  return (a[0] * (1 - fx) + a[1] * fx) * (1 - fy) + (b[0] * (1 - fx) + b[1] * fx) * fy;
}

using Costs = std::array<double, kLevels>;

/// By distance alone: inside an ellipse that holds face and hair all follows, beyond twice its size nothing
/// does.
double guess(const Pose& seen, glm::dvec2 p) {
  const double e = seen.eye_distance_px(), c = std::cos(seen.roll), s = std::sin(seen.roll);
  const glm::dvec2 d = (p - seen.shift) / e;
  const glm::dvec2 own(c * d.x + s * d.y, -s * d.x + c * d.y);
  const double r = std::hypot(own.x / 1.45, (own.y - 0.3) / 1.95);
  return kFollowOne * std::clamp(2.3 - 1.3 * r, 0.0, 1.0);
}

}  // namespace

SurroundMap fit_surround(const Setup& setup, const Geometry& geometry, const SeenPicture& first,
                         std::span<const SeenPicture> later) {
  const int w = setup.format.width, h = setup.format.height;
  const double cell = std::max(w, h) / static_cast<double>(kCellsAlongLongSide);
  SurroundMap map;
  map.columns = std::max(2, static_cast<int>(std::lround(w / cell)));
  map.rows = std::max(2, static_cast<int>(std::lround(h / cell)));
  const int stride = map.columns + 1;
  const auto points = static_cast<std::size_t>(stride) * static_cast<std::size_t>(map.rows + 1);
  map.head.assign(points, kFollowOne);
  map.body.assign(points, 0);

  // Where each point goes when it follows wholly.
  const SceneGeometry whole(setup, geometry, map, first.state);
  const auto inner = [&](const State& state) {
    const std::vector<glm::ivec2> all = whole.project(state).surround;
    std::vector<glm::ivec2> out;
    for (int r = 0; r <= map.rows; ++r)
      for (int c = 0; c <= map.columns; ++c)
        out.push_back(all[static_cast<std::size_t>((r + 1) * (map.columns + 3) + c + 1)]);
    return out;
  };
  const std::vector<glm::ivec2> regular = inner(first.state);
  std::vector<Costs> data(points, Costs{});
  for (const SeenPicture& seen : later) {
    const std::vector<glm::ivec2> moved = inner(seen.state);
    for (std::size_t k = 0; k < points; ++k) {
      const glm::dvec2 p = glm::dvec2(regular[k]) / 64.0, d = glm::dvec2(moved[k] - regular[k]) / 64.0;
      for (int v = 0; v < kSamplesAcross; ++v) {
        for (int u = 0; u < kSamplesAcross; ++u) {
          const double x = p.x + cell * 1.6 * (u / (kSamplesAcross - 1.0) - 0.5);
          const double y = p.y + cell * 1.6 * (v / (kSamplesAcross - 1.0) - 0.5);
          if (x < 0 || y < 0 || x >= w || y >= h) continue;
          const double was = at(first.picture->y, x, y);
          for (int level = 0; level < kLevels; ++level) {
            const double share = level / static_cast<double>(kFollowOne);
            const double r = std::min(kMaxDifference,
                                      std::abs(at(seen.picture->y, x + share * d.x, y + share * d.y) - was));
            data[k][static_cast<std::size_t>(level)] +=
                r * r / (kSamplesAcross * kSamplesAcross * static_cast<double>(later.size()));
          }
        }
      }
    }
  }

  const Pose seen_pose = pose_of(first.state);
  for (std::size_t k = 0; k < points; ++k) {
    const double g = guess(seen_pose, glm::dvec2(regular[k]) / 64.0);
    for (int level = 0; level < kLevels; ++level)
      data[k][static_cast<std::size_t>(level)] += kPrior * std::abs(level - g);
    map.head[k] =
        static_cast<std::uint8_t>(std::min_element(data[k].begin(), data[k].end()) - data[k].begin());
  }
  const auto border = [&](int r, int c) { return r == 0 || c == 0 || r == map.rows || c == map.columns; };
  for (int sweep = 0; sweep < 6; ++sweep) {
    for (int r = 0; r <= map.rows; ++r) {
      for (int c = 0; c <= map.columns; ++c) {
        const auto k = static_cast<std::size_t>(r * stride + c);
        if (border(r, c)) {  // the picture's border stays: SPEC 10.1
          map.head[k] = 0;
          continue;
        }
        Costs cost = data[k];
        for (const auto& [dr, dc] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
          if (border(r + dr, c + dc)) continue;
          const int neighbour = map.head[static_cast<std::size_t>((r + dr) * stride + c + dc)];
          for (int level = 0; level < kLevels; ++level)
            cost[static_cast<std::size_t>(level)] += kSmooth * std::abs(level - neighbour);
        }
        map.head[k] = static_cast<std::uint8_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
      }
    }
  }
  return map;
}

}  // namespace fbs
