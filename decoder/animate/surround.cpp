#include "decoder/animate/surround.h"

#include <algorithm>
#include <numeric>

#include "decoder/animate/fixed_math.h"

namespace fbs {
namespace {

/// Below this determinant (Q14) of the seen pose's upper-left 2 x 2 rotation nothing follows the head: it is
/// seen from the side and its plane cannot be inverted.
constexpr std::int64_t kMinSeenDeterminant = 1 << 11;

/// The grid begins this far inside the picture: the outermost samples of many videos are dark, and would be a
/// line across it wherever the border moves inwards.
constexpr std::int64_t kInset = 2 << kScreenOneLog2;

constexpr std::int64_t kMaxFromHead = 64 << 8;  // 1/256 eye distance

/// The way of a point of the head frame's plane z = 0 from the seen pose to another one.
class HeadWay {
 public:
  HeadWay(const HeadPose& seen_pose, const HeadPose& now_pose) : seen_(seen_pose), now_(now_pose) {
    if (seen_pose == now_pose) return;
    const HeadProjection seen(seen_pose), now(now_pose);
    const auto& a = now.rotation;
    const auto& b = seen.rotation;
    const std::int64_t det =
        round_shift(std::int64_t{b[0][0]} * b[1][1] - std::int64_t{b[0][1]} * b[1][0], kRotationOneLog2);
    if (det < kMinSeenDeterminant) return;
    moves_ = true;
    const std::int64_t ratio = (now.scale << 16) / seen.scale;                      // Q16
    const std::int64_t inverse[2][2] = {{b[1][1], -b[0][1]}, {-b[1][0], b[0][0]}};  // times 1 / det
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const std::int64_t q14 = (a[i][0] * inverse[0][j] + a[i][1] * inverse[1][j]) / det;
        m_[i][j] = std::clamp<std::int64_t>(round_shift(q14 * ratio, 14), -(1 << 20), 1 << 20);
      }
  }

  [[nodiscard]] glm::ivec2 of(glm::ivec2 p) const {
    if (!moves_) return {0, 0};
    const std::int64_t dx = p.x - seen_.shift_x, dy = p.y - seen_.shift_y;
    return {clamp_screen(now_.shift_x + round_shift(m_[0][0] * dx + m_[0][1] * dy, 16) - p.x),
            clamp_screen(now_.shift_y + round_shift(m_[1][0] * dx + m_[1][1] * dy, 16) - p.y)};
  }

 private:
  const HeadPose& seen_;
  const HeadPose& now_;
  bool moves_ = false;
  std::int64_t m_[2][2] = {};  // Q16
};

/// The way of a point of body or ground.
glm::ivec2 flat_way(const std::array<std::int32_t, kSimilarityCount>& s,
                    const std::array<std::int32_t, kSimilarityCount>& seen, glm::ivec2 from_head) {
  const std::int64_t growth = s[kSimilarityScale] - seen[kSimilarityScale],
                     turn = s[kSimilarityRotation] - seen[kSimilarityRotation];
  return {clamp_screen(s[kDisplacementX] - seen[kDisplacementX] +
                       round_shift(growth * from_head.x - turn * from_head.y, 8)),
          clamp_screen(s[kDisplacementY] - seen[kDisplacementY] +
                       round_shift(growth * from_head.y + turn * from_head.x, 8))};
}

}  // namespace

Surround::Surround(const VideoFormat& format, SurroundMap map, const State& seen_state)
    : map_(std::move(map)), seen_(seen_state) {
  const HeadPose seen = head_pose(seen_);
  const std::int64_t width = std::int64_t{format.width} << kScreenOneLog2,
                     height = std::int64_t{format.height} << kScreenOneLog2;
  const auto along = [](std::int64_t size, int k, int of) {
    if (k < 0) return kInset - size / 2;
    return kInset + (k > of ? size + size / 2 - 2 * kInset : (size - 2 * kInset) * k / of);
  };
  const std::int64_t scale = HeadProjection(seen).scale;
  const auto from_head = [&](std::int64_t away) {
    // 1/64 pixel to 1/256 eye distance; scale is pixels per eye distance in Q16
    return static_cast<int>(
        std::clamp(away * (1 << 18) / std::max<std::int64_t>(scale, 1), -kMaxFromHead, kMaxFromHead));
  };
  const int across = map_.columns, down = map_.rows;
  for (int r = -1; r <= down + 1; ++r) {
    for (int c = -1; c <= across + 1; ++c) {
      const auto k =
          static_cast<std::size_t>(std::clamp(r, 0, down) * (across + 1) + std::clamp(c, 0, across));
      const glm::ivec2 at(along(width, c, across), along(height, r, down));
      // The margin moves as the border does.
      const glm::ivec2 on(along(width, std::clamp(c, 0, across), across),
                          along(height, std::clamp(r, 0, down), down));
      points_.push_back(
          {at,
           {from_head(std::int64_t{on.x} - seen.shift_x), from_head(std::int64_t{on.y} - seen.shift_y)},
           map_.head[k],
           map_.body[k]});
      texture_.push_back(on);
    }
  }
  std::vector<int> ranks;
  for (int r = -1; r <= down; ++r) {
    for (int c = -1; c <= across; ++c) {
      const auto at = [&](int dc, int dr) { return static_cast<int>(index(c + dc, r + dr)); };
      const Cell cell = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
      int rank = 0;
      for (const int i : cell) {
        const Point& p = points_[i];
        rank += 2 * kFollowOne * p.head + p.body;
      }
      cells_.push_back(cell);
      ranks.push_back(rank);
    }
  }
  std::vector<std::size_t> order(cells_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
  std::vector<Cell> sorted;
  for (const std::size_t i : order) sorted.push_back(cells_[i]);
  cells_ = std::move(sorted);
}

std::size_t Surround::index(int column, int row) const {
  return static_cast<std::size_t>((row + 1) * (map_.columns + 3) + column + 1);
}

void Surround::project(const State& state, std::vector<glm::ivec2>& out) const {
  const HeadPose pose = head_pose(state);
  const HeadPose seen = head_pose(seen_);
  const HeadWay head(seen, pose);
  out.resize(points_.size());
  for (int r = -1; r <= map_.rows + 1; ++r) {
    for (int c = -1; c <= map_.columns + 1; ++c) {
      const Point& p = points_[index(c, r)];
      const Point& on = points_[index(std::clamp(c, 0, map_.columns), std::clamp(r, 0, map_.rows))];
      const glm::ivec2 by_body = flat_way(state.body, seen_.body, p.from_head),
                       by_ground = flat_way(state.ground, seen_.ground, p.from_head);
      const glm::ivec2 flat = by_ground + (by_body - by_ground) * p.body / kFollowOne;
      const glm::ivec2 way = p.head == 0 ? flat : flat + (head.of(on.seen) - flat) * p.head / kFollowOne;
      out[index(c, r)] = {clamp_screen(p.seen.x + way.x), clamp_screen(p.seen.y + way.y)};
    }
  }
}

Surround::Place Surround::place(glm::ivec2 seen) const {
  const glm::ivec2 last = points_[index(map_.columns, map_.rows)].seen;
  const glm::ivec2 first = points_[index(0, 0)].seen;
  const glm::ivec2 inside(std::clamp(seen.x, first.x, last.x), std::clamp(seen.y, first.y, last.y));
  int column = 0, row = 0;
  while (column + 1 < map_.columns && points_[index(column + 1, 0)].seen.x <= inside.x) ++column;
  while (row + 1 < map_.rows && points_[index(0, row + 1)].seen.y <= inside.y) ++row;
  Place p{seen, {}, 0, 0};
  for (int i = 0; i < 4; ++i) p.corner[i] = static_cast<int>(index(column + i % 2, row + i / 2));
  const glm::ivec2 low = points_[index(column, row)].seen, high = points_[index(column + 1, row + 1)].seen;
  p.across = (inside.x - low.x) * 256 / (high.x - low.x);
  p.down = (inside.y - low.y) * 256 / (high.y - low.y);
  return p;
}

glm::ivec2 Surround::carried(const Place& p, std::span<const glm::ivec2> moved) const {
  std::array<glm::ivec2, 4> way;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto k = static_cast<std::size_t>(p.corner[i]);
    way[i] = moved[k] - points_[k].seen;
  }
  const auto blend = [&](auto component) {
    const std::int64_t top =
        std::int64_t{way[0].*component} * (256 - p.across) + std::int64_t{way[1].*component} * p.across;
    const std::int64_t bottom =
        std::int64_t{way[2].*component} * (256 - p.across) + std::int64_t{way[3].*component} * p.across;
    return round_shift(top * (256 - p.down) + bottom * p.down, 16);
  };
  return {clamp_screen(p.seen.x + blend(&glm::ivec2::x)), clamp_screen(p.seen.y + blend(&glm::ivec2::y))};
}

}  // namespace fbs
