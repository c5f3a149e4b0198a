#include "encoder/surround/surround_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "decoder/animate/scene_geometry.h"
#include "encoder/image/planes.h"
#include "encoder/model/pose.h"
#include "encoder/surround/surround_motion.h"

namespace fbs {
namespace {
constexpr double kCellsAlongLongSide = 22;
constexpr int kWorkLongSide = 360;  // pixels
constexpr double kMaxDifference =
    45;                            // grey levels; what differs more is something else that has come into view
constexpr int kSamplesAcross = 5;  // of a cell, each way
constexpr double kSmooth =
    12;  // cost of a quarter's change between neighbours, in squared grey levels over a cell
constexpr double kPrior = 4;  // cost of a quarter away from the guess by place
constexpr int kSweeps = 3;

/// What a point of the map may say.
struct Label {
  std::uint8_t head, body;
};
const std::vector<Label>& labels() {
  static const std::vector<Label> all = [] {
    std::vector<Label> out;
    for (std::uint8_t h = 0; h <= kFollowOne; ++h)
      for (std::uint8_t b = 0; b <= (h == kFollowOne ? 0 : kFollowOne); ++b) out.push_back({h, b});
    return out;
  }();
  return all;
}

/// Distance of two labels in quarters: of what goes with the head, and of the rest.
double apart(const Label& a, const Label& b) {
  const double head = std::abs(a.head - b.head);
  const double rest = std::min(kFollowOne - a.head, kFollowOne - b.head) / static_cast<double>(kFollowOne);
  return head + rest * std::abs(a.body - b.body);
}

class MapFit {
 public:
  MapFit(const Setup& setup, const Geometry& geometry, const SeenPicture& first,
         std::span<const SeenPicture> later)
      : width_(setup.format.width), height_(setup.format.height) {
    const double cell = std::max(width_, height_) / static_cast<double>(kCellsAlongLongSide);
    map_.columns = std::max(2, static_cast<int>(std::lround(width_ / cell)));
    map_.rows = std::max(2, static_cast<int>(std::lround(height_ / cell)));
    stride_ = static_cast<std::size_t>(map_.columns) + 1;
    const std::size_t points = stride_ * (static_cast<std::size_t>(map_.rows) + 1);
    labels_.assign(points, {0, 0});
    visited_.assign(points, 0);
    changed_.assign(points, 0);
    const Pose seen = pose_of(first.state);
    map_.head.assign(points, 0);
    map_.body.assign(points, 0);
    seen_ = inner(SceneGeometry(setup, geometry, map_, first.state).texture_mesh(first.state).surround);
    for (std::size_t k = 0; k < points; ++k) {
      const auto place = layers_by_place(seen, place_of(k));
      const double rest = std::max(0.01, 1.0 - static_cast<double>(place[0]));
      guess_.push_back(
          {kFollowOne * static_cast<double>(place[0]), kFollowOne * static_cast<double>(place[1]) / rest});
    }
    factor_ = (std::max(width_, height_) + kWorkLongSide - 1) / kWorkLongSide;
    first_ = reduced(*first.picture);
    for (const SeenPicture& picture : later) add(setup, geometry, first.state, picture);
  }

  SurroundMap solve() {
    start();
    if (!later_.empty())
      for (int sweep = 0; sweep < kSweeps; ++sweep)
        if (!improve()) break;
    map_.head.clear();
    map_.body.clear();
    for (const Label& l : labels_) {
      map_.head.push_back(l.head);
      map_.body.push_back(l.body);
    }
    return std::move(map_);
  }

 private:
  using Labels = std::vector<Label>;
  /// A later picture, and where points of the grid go that go wholly with something.
  struct Later {
    cv::Mat luma;
    cv::Mat hidden;                              // by the head
    std::array<std::vector<glm::dvec2>, 3> way;  // with head, body, ground: work pixels
  };

  [[nodiscard]] glm::dvec2 place_of(std::size_t k) const { return seen_[k]; }

  /// The grid's points without its margin, pixels.
  [[nodiscard]] std::vector<glm::dvec2> inner(const std::vector<glm::ivec2>& with_margin) const {
    std::vector<glm::dvec2> out;
    for (int r = 0; r <= map_.rows; ++r)
      for (int c = 0; c <= map_.columns; ++c)
        out.push_back(glm::dvec2(with_margin[(r + 1) * (map_.columns + 3) + c + 1]) / 64.0);
    return out;
  }

  [[nodiscard]] cv::Mat reduced(const Picture& picture) const {
    const cv::Mat whole = view(picture.y);
    if (factor_ == 1) return whole.clone();
    cv::Mat out;
    cv::resize(whole, out, {width_ / factor_, height_ / factor_}, 0, 0, cv::INTER_AREA);
    return out;
  }

  void add(const Setup& setup, const Geometry& geometry, const State& seen, const SeenPicture& picture) {
    Later later;
    later.luma = reduced(*picture.picture);
    const std::array<Label, 3> wholly = {Label{kFollowOne, 0}, {0, kFollowOne}, {0, 0}};
    for (std::size_t i = 0; i < 3; ++i) {
      SurroundMap map = map_;
      map.head.assign(labels_.size(), wholly[i].head);
      map.body.assign(labels_.size(), wholly[i].body);
      const SceneGeometry scene(setup, geometry, map, seen);
      later.way[i] = inner(scene.screen_mesh(picture.state).surround);
      for (std::size_t k = 0; k < seen_.size(); ++k)
        later.way[i][k] = (later.way[i][k] - seen_[k]) / static_cast<double>(factor_);
      if (i > 0) continue;
      const auto vertices = scene.project_vertices(picture.state);
      std::vector<cv::Point> outline;
      for (const std::uint16_t v : generic_head().outline) {
        const auto& p = vertices[v];
        outline.emplace_back(p.x / (64 * factor_), p.y / (64 * factor_));
      }
      later.hidden = cv::Mat::zeros(later.luma.size(), CV_8U);
      cv::fillPoly(later.hidden, std::vector<std::vector<cv::Point>>{outline}, cv::Scalar(255));
    }
    later_.push_back(std::move(later));
  }

  [[nodiscard]] static glm::dvec2 way(const Later& later, std::size_t k, const Label& l) {
    const double h = l.head / static_cast<double>(kFollowOne), b = l.body / static_cast<double>(kFollowOne);
    const glm::dvec2 flat = later.way[2][k] + b * (later.way[1][k] - later.way[2][k]);
    return flat + h * (later.way[0][k] - flat);
  }

  [[nodiscard]] static float value(const cv::Mat& luma, float x, float y) {
    x = std::clamp(x - 0.5F, 0.0F, static_cast<float>(luma.cols) - 1.01F);
    y = std::clamp(y - 0.5F, 0.0F, static_cast<float>(luma.rows) - 1.01F);
    const int i = static_cast<int>(x), j = static_cast<int>(y);
    const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
    const std::uint8_t *a = luma.ptr(j) + i, *b = luma.ptr(j + 1) + i;
    const float top = a[0] + (a[1] - a[0]) * fx, bottom = b[0] + (b[1] - b[0]) * fx;
    return top + (bottom - top) * fy;
  }

  /// Points that move a cell's corners, row by row. The margin's, which are as wide as others here, move as
  /// the border does.
  [[nodiscard]] std::array<std::size_t, 4> corners_of(int column, int row) const {
    std::array<std::size_t, 4> k{};
    for (int i = 0; i < 4; ++i)
      k[i] = static_cast<std::size_t>(std::clamp(row + i / 2, 0, map_.rows)) * stride_ +
             static_cast<std::size_t>(std::clamp(column + i % 2, 0, map_.columns));
    return k;
  }

  /// Mean over pictures and the cell's area of the squared difference that shows, when its corners (row by
  /// row) have these labels.
  [[nodiscard]] double cost_of_cell(int column, int row, const std::array<Label, 4>& corner) const {
    const std::array<std::size_t, 4> k = corners_of(column, row);
    const glm::dvec2 first = seen_.front() / static_cast<double>(factor_),
                     last = seen_.back() / static_cast<double>(factor_);
    const glm::dvec2 size = (last - first) / glm::dvec2(map_.columns, map_.rows);
    const glm::dvec2 low = first + glm::dvec2(column, row) * size, high = low + size;
    const glm::vec2 begin(first), end(last);
    const auto limit = static_cast<float>(kMaxDifference * kMaxDifference);
    double sum = 0;
    for (const Later& later : later_) {
      std::array<glm::dvec2, 4> to;
      for (std::size_t i = 0; i < 4; ++i)
        to[i] = glm::dvec2(i % 2 == 0 ? low.x : high.x, i < 2 ? low.y : high.y) + way(later, k[i], corner[i]);
      const glm::dvec2 d1 = to[3] - to[0], d2 = to[2] - to[1];
      const double area = 0.5 * (d1.x * d2.y - d1.y * d2.x) / ((high.x - low.x) * (high.y - low.y));
      if (area < 0.05) {
        sum += kMaxDifference * kMaxDifference;
        continue;
      }
      float of_picture = 0;
      for (int v = 0; v < kSamplesAcross; ++v) {
        const float fy = (static_cast<float>(v) + 0.5F) / kSamplesAcross;
        const glm::vec2 left = glm::vec2(to[0]) * (1 - fy) + glm::vec2(to[2]) * fy,
                        right = glm::vec2(to[1]) * (1 - fy) + glm::vec2(to[3]) * fy;
        const float y = static_cast<float>(low.y) + static_cast<float>(high.y - low.y) * fy;
        for (int u = 0; u < kSamplesAcross; ++u) {
          const float fx = (static_cast<float>(u) + 0.5F) / kSamplesAcross;
          const glm::vec2 p = left * (1 - fx) + right * fx;
          if (!(p.x >= 0 && p.y >= 0 && p.x < static_cast<float>(later.luma.cols) &&
                p.y < static_cast<float>(later.luma.rows)))
            continue;
          if (later.hidden.ptr(static_cast<int>(p.y))[static_cast<int>(p.x)] != 0) continue;
          const float x = static_cast<float>(low.x) + static_cast<float>(high.x - low.x) * fx;
          const float r = value(later.luma, p.x, p.y) -
                          value(first_, std::clamp(x, begin.x, end.x), std::clamp(y, begin.y, end.y));
          of_picture += std::min(limit, r * r);
        }
      }
      sum += static_cast<double>(of_picture) * area / (kSamplesAcross * kSamplesAcross);
    }
    return sum / static_cast<double>(later_.size());
  }

  [[nodiscard]] double prior(std::size_t k, const Label& l) const {
    const double rest = (kFollowOne - l.head) / static_cast<double>(kFollowOne);
    return kPrior * (std::abs(l.head - guess_[k].x) + rest * std::abs(l.body - guess_[k].y));
  }

  /// Of a label among its neighbours.
  [[nodiscard]] double smoothness(std::size_t k, const Label& l) const {
    const std::size_t c = k % stride_;
    double sum = 0;
    if (c > 0) sum += apart(l, labels_[k - 1]);
    if (c + 1 < stride_) sum += apart(l, labels_[k + 1]);
    if (k >= stride_) sum += apart(l, labels_[k - stride_]);
    if (k + stride_ < labels_.size()) sum += apart(l, labels_[k + stride_]);
    return kSmooth * sum;
  }

  /// Each point as if its surroundings went with it.
  void start() {
    const std::size_t n = labels().size();
    std::vector<double> of_cell(later_.empty() ? 0 : labels_.size() * n, 0.0);
    for (int r = -1; r <= map_.rows && !later_.empty(); ++r)
      for (int c = -1; c <= map_.columns; ++c)
        for (std::size_t i = 0; i < n; ++i) {
          const Label l = labels()[i];
          const double cost = cost_of_cell(c, r, {l, l, l, l});
          for (const std::size_t k : corners_of(c, r)) of_cell[k * n + i] += cost / 2;
        }
    for (int sweep = 0; sweep < 6; ++sweep) {
      for (std::size_t k = 0; k < labels_.size(); ++k) {
        double least = 1e30;
        Label best{};
        for (std::size_t i = 0; i < n; ++i) {
          const Label l = labels()[i];
          const double cost =
              (of_cell.empty() ? 0 : of_cell[k * n + i]) + prior(k, l) + (sweep > 0 ? smoothness(k, l) : 0);
          if (cost < least) {
            least = cost;
            best = l;
          }
        }
        labels_[k] = best;
      }
    }
  }

  /// One sweep on the cells as they are drawn; false when nothing changed.
  bool improve() {
    bool changed = false;
    for (std::size_t k = 0; k < labels_.size(); ++k) {
      const int c = static_cast<int>(k % stride_), r = static_cast<int>(k / stride_);
      if (changed_round(c, r) < visited_[k]) continue;
      visited_[k] = ++visits_;
      const auto cost = [&](const Label& l) {
        const Label was = std::exchange(labels_[k], l);
        double sum = prior(k, l) + smoothness(k, l);
        for (int row = r - 1; row <= r; ++row)
          for (int column = c - 1; column <= c; ++column) {
            const auto i = corners_of(column, row);
            sum += cost_of_cell(column, row, {labels_[i[0]], labels_[i[1]], labels_[i[2]], labels_[i[3]]});
          }
        labels_[k] = was;
        return sum;
      };
      double least = cost(labels_[k]) - 1e-9;
      Label best = labels_[k];
      for (const Label& l : labels()) {
        if (apart(l, labels_[k]) > 2 && !near(k, l)) continue;
        if (const double now = cost(l); now < least) {
          least = now;
          best = l;
        }
      }
      if (best.head == labels_[k].head && best.body == labels_[k].body) continue;
      changed = true;
      changed_[k] = visits_;
      labels_[k] = best;
    }
    return changed;
  }

  /// The visit in which a point or one of those round it changed last.
  [[nodiscard]] int changed_round(int column, int row) const {
    int last = 0;
    for (int r = std::max(0, row - 1); r <= std::min(map_.rows, row + 1); ++r)
      for (int c = std::max(0, column - 1); c <= std::min(map_.columns, column + 1); ++c)
        last = std::max(last, changed_[static_cast<std::size_t>(r) * stride_ + static_cast<std::size_t>(c)]);
    return last;
  }

  /// Whether a neighbour has that label.
  [[nodiscard]] bool near(std::size_t k, const Label& l) const {
    const std::size_t c = k % stride_;
    const auto is = [&](std::size_t i) { return labels_[i].head == l.head && labels_[i].body == l.body; };
    return (c > 0 && is(k - 1)) || (c + 1 < stride_ && is(k + 1)) || (k >= stride_ && is(k - stride_)) ||
           (k + stride_ < labels_.size() && is(k + stride_));
  }

  int width_, height_, factor_ = 1;
  SurroundMap map_;
  std::size_t stride_ = 0;
  Labels labels_;
  int visits_ = 0;
  std::vector<int> visited_, changed_;  ///< the visit in which a point was seen last, and changed last
  std::vector<glm::dvec2> seen_;        ///< the points in the first picture, pixels
  std::vector<glm::dvec2> guess_;       ///< head, body of each point
  cv::Mat first_;
  std::vector<Later> later_;
};

}  // namespace

SurroundMap fit_surround(const Setup& setup, const Geometry& geometry, const SeenPicture& first,
                         std::span<const SeenPicture> later) {
  return MapFit(setup, geometry, first, later).solve();
}

SurroundMap still_surround() {
  return {1, 1, {0, 0, 0, 0}, {0, 0, 0, 0}};
}

}  // namespace fbs
