#include "decoder/animate/surround.h"

#include <algorithm>
#include <numeric>

#include "decoder/animate/layer_motion.h"
#include "decoder/head/fixed_math.h"

namespace fbs {
namespace {

/// The grid begins this far inside the picture: the outermost samples of many videos are dark, and would be
/// seen as a line wherever the border moves inwards.
constexpr std::int64_t kInset = to_screen(2);

constexpr std::int64_t kMaxFromHead = 64 << kFromHeadOneLog2;  // sixty-four eye distances

constexpr int kCellOneLog2 = 8;  // positions in a cell are in 1/256 of it
constexpr int kCellOne = 1 << kCellOneLog2;

/// Coordinate of a grid column or row in the rest state, 1/64 pixel.
/// @param size  of the picture, 1/64 pixel  @param k  -1..cells + 1
std::int64_t regular(std::int64_t size, int k, int cells) {
  if (k < 0) return kInset - size / 2;
  if (k > cells) return size + size / 2 - kInset;
  return kInset + (size - 2 * kInset) * k / cells;
}

}  // namespace

SurroundMap still_surround() {
  return {1, 1, {0, 0, 0, 0}, {0, 0, 0, 0}};
}

Surround::Surround(const VideoFormat& format, SurroundMap map, const State& rest)
    : map_(std::move(map)), rest_(rest) {
  place_points(format);
  order_cells();
  shares_.reserve(points_.size());
  for (const Point& p : points_) shares_.push_back(surround_shares(p.head, p.body));
}

void Surround::place_points(const VideoFormat& format) {
  const HeadPose head = head_pose(rest_);
  const std::int64_t width = to_screen(format.width), height = to_screen(format.height);
  const std::int64_t scale = std::max<std::int64_t>(HeadProjection(head).scale, 1);
  const auto from_head = [&](std::int64_t away) {
    constexpr int kToEyeDistances = kScaleOneLog2 + kFromHeadOneLog2 - kScreenOneLog2;
    return static_cast<int>(
        std::clamp(away * (std::int64_t{1} << kToEyeDistances) / scale, -kMaxFromHead, kMaxFromHead));
  };
  for (int r = -1; r <= map_.rows + 1; ++r) {
    for (int c = -1; c <= map_.columns + 1; ++c) {
      const int base_c = std::clamp(c, 0, map_.columns), base_r = std::clamp(r, 0, map_.rows);
      const int k = base_r * (map_.columns + 1) + base_c;
      const glm::ivec2 at(regular(width, c, map_.columns), regular(height, r, map_.rows));
      const glm::ivec2 base(regular(width, base_c, map_.columns), regular(height, base_r, map_.rows));
      points_.push_back(
          {at,
           {from_head(std::int64_t{base.x} - head.shift_x), from_head(std::int64_t{base.y} - head.shift_y)},
           map_.head[k],
           map_.body[k],
           index(base_c, base_r)});
    }
  }
}

void Surround::order_cells() {
  std::vector<Cell> cells;
  std::vector<int> ranks;
  for (int r = -1; r <= map_.rows; ++r) {
    for (int c = -1; c <= map_.columns; ++c) {
      const Cell cell = {index(c, r), index(c + 1, r), index(c + 1, r + 1), index(c, r + 1)};
      int rank = 0;
      for (const int i : cell) rank += 2 * kFollowOne * points_[i].head + points_[i].body;
      cells.push_back(cell);
      ranks.push_back(rank);
    }
  }
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
  for (const std::size_t i : order) cells_.push_back(cells[i]);
}

std::vector<MeshTriangle> Surround::triangles() const {
  std::vector<MeshTriangle> out;
  for (const Cell& c : cells_) {
    out.push_back({c[0], c[1], c[2]});
    out.push_back({c[0], c[2], c[3]});
  }
  return out;
}

int Surround::index(int column, int row) const {
  return (row + 1) * (map_.columns + 3) + column + 1;
}

void Surround::project(const State& state, std::vector<glm::ivec2>& out) const {
  const HeadPlane head(head_pose(rest_), head_pose(state));
  out.resize(points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& p = points_[k];
    const glm::ivec2 by_body = similarity_displacement(rest_.body, state.body, p.from_head),
                     by_ground = similarity_displacement(rest_.ground, state.ground, p.from_head);
    glm::ivec2 displacement = by_ground + (by_body - by_ground) * p.body / kFollowOne;
    if (p.head != 0)
      displacement += (head.displacement(points_[p.base].rest) - displacement) * p.head / kFollowOne;
    out[k] = {clamp_screen(p.rest.x + displacement.x), clamp_screen(p.rest.y + displacement.y)};
  }
}

Surround::Place Surround::place(glm::ivec2 rest) const {
  const glm::ivec2 first = points_[index(0, 0)].rest, last = points_[index(map_.columns, map_.rows)].rest;
  const glm::ivec2 inside(std::clamp(rest.x, first.x, last.x), std::clamp(rest.y, first.y, last.y));
  int column = 0, row = 0;
  while (column + 1 < map_.columns && points_[index(column + 1, 0)].rest.x <= inside.x) ++column;
  while (row + 1 < map_.rows && points_[index(0, row + 1)].rest.y <= inside.y) ++row;
  Place p{rest, {}, 0, 0};
  for (int i = 0; i < 4; ++i) p.corner[i] = index(column + i % 2, row + i / 2);
  const glm::ivec2 low = points_[index(column, row)].rest, high = points_[index(column + 1, row + 1)].rest;
  p.across = (inside.x - low.x) * kCellOne / (high.x - low.x);
  p.down = (inside.y - low.y) * kCellOne / (high.y - low.y);
  return p;
}

RegionShares Surround::shares_at(const Place& p) const {
  const std::array<int, 4> part = {(kCellOne - p.across) * (kCellOne - p.down),
                                   p.across * (kCellOne - p.down), (kCellOne - p.across) * p.down,
                                   p.across * p.down};
  RegionShares out{};
  int left = kShareOne;
  for (const Region region : {Region::kHair, Region::kBody}) {
    const auto r = static_cast<std::size_t>(region);
    int sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += part[i] * shares_[p.corner[i]][r];
    out[r] = static_cast<std::uint8_t>(std::min(left, static_cast<int>(round_shift(sum, 2 * kCellOneLog2))));
    left -= out[r];
  }
  out[static_cast<std::size_t>(Region::kGround)] = static_cast<std::uint8_t>(left);
  return out;
}

glm::ivec2 Surround::carried(const Place& p, std::span<const glm::ivec2> moved) const {
  std::array<glm::ivec2, 4> d;
  for (std::size_t i = 0; i < 4; ++i) d[i] = moved[p.corner[i]] - points_[p.corner[i]].rest;
  const auto blend = [&](auto component) {
    const std::int64_t top =
        std::int64_t{d[0].*component} * (kCellOne - p.across) + std::int64_t{d[1].*component} * p.across;
    const std::int64_t bottom =
        std::int64_t{d[2].*component} * (kCellOne - p.across) + std::int64_t{d[3].*component} * p.across;
    return round_shift(top * (kCellOne - p.down) + bottom * p.down, 2 * kCellOneLog2);
  };
  return {clamp_screen(p.rest.x + blend(&glm::ivec2::x)), clamp_screen(p.rest.y + blend(&glm::ivec2::y))};
}

}  // namespace fbs
