#include "encoder/track/face_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <span>

#include "encoder/image/planes.h"

namespace fbs {
namespace {

constexpr int kEverywhereEvery = 2;          // lost pictures
constexpr double kWorthSettling = 0.35;      // correlation at the coarsest level
constexpr double kWorthSettlingThere = 0.1;  // correlation where the head was
constexpr std::size_t kSettled = 2;          // of the grid's best
constexpr double kSizeChange = 0.5;          // log2, against the last good pose
constexpr double kFarthestTurn = 0.9;        // rad of yaw or pitch; beyond, hardly a face is seen
constexpr double kInside = 0.7;              // of the head's points, in the picture
constexpr double kFlat = 4;                  // grey levels of standard deviation: nothing is seen
constexpr double kDegree = std::numbers::pi / 180;

/// Poses round one: steps of turn (rad) and size (log2), and how far the place may be off (eye distances).
struct Grid {
  std::span<const double> yaw, pitch, size;
  double reach;
};
constexpr std::array kYaw = {-30 * kDegree, -15 * kDegree, 0.0, 15 * kDegree, 30 * kDegree};
constexpr std::array kPitch = {-15 * kDegree, 0.0, 15 * kDegree};
constexpr std::array kSize = {-0.15, 0.0, 0.15};
constexpr Grid kAround = {kYaw, kPitch, kSize, 1.0};
constexpr Grid kAtAFind = {kYaw, kPitch, kSize, 0.4};

bool shows_nothing(const cv::Mat& luma) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(luma, mean, deviation);
  return deviation[0] < kFlat;
}

/// The head's appearance against a picture at the coarsest level, by whole pixels and with few points: for
/// the grid.
class CoarseLook {
 public:
  CoarseLook(const HeadTracker& head, const HeadVertices& vertices, const LevelledFrame& now)
      : now_(now), vertices_(vertices) {
    constexpr std::size_t kPoints = 250;
    const auto seen = head.seen(kLevel);
    const std::size_t step = std::max<std::size_t>(1, seen.size() / kPoints);
    for (std::size_t k = 0; k < seen.size(); k += step) {
      if (seen[k] < 0) continue;
      const SurfacePoint& p = head.points()[k];
      points_.push_back({p.on(vertices), p.corner, seen[k], head.weights()[k]});
    }
    for (const Point& p : points_) centre_ += p.place / static_cast<double>(points_.size());
    cv::copyMakeBorder(now.levels[kLevel], level_, kBorder, kBorder, kBorder, kBorder, cv::BORDER_CONSTANT,
                       cv::Scalar(128));
  }

  /// What the head turns about while its turn is tried: the middle of its points.
  [[nodiscard]] glm::dvec3 centre() const { return centre_; }

  /// The best place within `reach` pixels of the picture round where `pose` has it.
  [[nodiscard]] TrackedPose best_place(Pose pose, double reach_px) {
    constexpr int kStep = 2;  // level pixels, a sixth of the eye distance
    const double to_level = now_.frame.scale / (1 << kLevel);
    const int reach = static_cast<int>(std::lround(reach_px * to_level / kStep)) * kStep;
    project(pose);
    if (taps_.size() < points_.size() / 2) return {pose, 0};
    glm::ivec2 best{0, 0};
    double most = 0;
    for (int y = -reach; y <= reach; y += kStep) {
      for (int x = -reach; x <= reach; x += kStep) {
        const double c = correlation({x, y});
        if (c > most) {
          most = c;
          best = {x, y};
        }
      }
    }
    pose.shift += glm::dvec2(best) / to_level;
    return {pose, most};
  }

 private:
  static constexpr int kLevel = LevelledFrame::kLevels - 1;
  static constexpr int kBorder = 12;  // level pixels: an eye distance

  struct Point {
    glm::dvec3 place;
    HeadTriangle corner;
    float seen, weight;
  };
  struct Tap {
    glm::ivec2 at;            ///< in level_
    float weight, deviation;  ///< of what was seen, from its mean, times the weight
  };

  /// Points that face the viewer.
  void project(const Pose& pose) {
    const PoseProjection projection(pose);
    taps_.clear();
    weight_ = 0;
    float mean = 0;
    low_ = {1 << 20, 1 << 20};
    high_ = {-(1 << 20), -(1 << 20)};
    for (const Point& p : points_) {
      const auto corner = [&](std::size_t i) { return projection(vertices_[p.corner[i]]); };
      const glm::dvec2 a = corner(0), e = corner(1) - a, f = corner(2) - a;
      if (e.x * f.y - e.y * f.x <= 0) continue;  // clockwise in the picture seen from the front
      const glm::dvec2 at = now_.at(projection(p.place), kLevel);
      const glm::ivec2 tap{static_cast<int>(std::lround(at.x)) + kBorder,
                           static_cast<int>(std::lround(at.y)) + kBorder};
      taps_.push_back({tap, p.weight, p.seen});
      low_ = {std::min(low_.x, tap.x), std::min(low_.y, tap.y)};
      high_ = {std::max(high_.x, tap.x), std::max(high_.y, tap.y)};
      weight_ += p.weight;
      mean += p.weight * p.seen;
    }
    mean /= std::max(weight_, 1e-6F);
    variance_ = 0;
    for (Tap& t : taps_) {
      t.deviation -= mean;
      variance_ += t.weight * t.deviation * t.deviation;
      t.deviation *= t.weight;
    }
  }

  [[nodiscard]] double correlation(glm::ivec2 by) const {
    if (low_.x + by.x < 0 || low_.y + by.y < 0 || high_.x + by.x >= level_.cols ||
        high_.y + by.y >= level_.rows)
      return 0;
    const std::size_t stride = level_.step[0];
    const std::uint8_t* origin = level_.ptr<std::uint8_t>(by.y) + by.x;
    float common = 0, sum = 0, squares = 0;
    for (const Tap& t : taps_) {
      const auto value = static_cast<float>(
          origin[static_cast<std::size_t>(t.at.y) * stride + static_cast<std::size_t>(t.at.x)]);
      common += t.deviation * value;
      sum += t.weight * value;
      squares += t.weight * value * value;
    }
    const float spread = squares - sum * sum / weight_;
    if (spread <= 0 || variance_ <= 0) return 0;
    return static_cast<double>(common / std::sqrt(spread * variance_));
  }

  const LevelledFrame& now_;
  const HeadVertices& vertices_;
  std::vector<Point> points_;
  glm::dvec3 centre_{0, 0, 0};
  cv::Mat level_;  ///< with its border
  std::vector<Tap> taps_;
  glm::ivec2 low_{}, high_{};  ///< bounds of the taps
  float weight_ = 0, variance_ = 0;
};

/// The best place of each turn and size of the grid, the likeliest first.
std::vector<TrackedPose> look_coarsely(const HeadTracker& head, const HeadVertices& vertices,
                                       const LevelledFrame& now, const Pose& round, const Grid& grid) {
  CoarseLook look(head, vertices, now);
  const glm::dvec2 middle = PoseProjection(round)(look.centre());
  std::vector<TrackedPose> out;
  for (const double yaw : grid.yaw) {
    for (const double pitch : grid.pitch) {
      for (const double size : grid.size) {
        Pose pose = round;
        pose.yaw += yaw;
        pose.pitch += pitch;
        pose.log2_scale += size;
        pose.shift += middle - PoseProjection(pose)(look.centre());
        out.push_back(look.best_place(pose, grid.reach * round.eye_distance_px()));
      }
    }
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.confidence > b.confidence; });
  return out;
}

/// Whether two poses are so near that both settle to the same.
bool alike(const Pose& a, const Pose& b) {
  const glm::dvec2 d = a.shift - b.shift;
  return std::hypot(d.x, d.y) < 0.25 * a.eye_distance_px() && std::abs(a.yaw - b.yaw) < 20 * kDegree &&
         std::abs(a.pitch - b.pitch) < 20 * kDegree;
}

glm::dvec3 middle_of(std::span<const glm::dvec3> points) {
  return std::accumulate(points.begin(), points.end(), glm::dvec3(0)) / static_cast<double>(points.size());
}

/// Whether a head is where it was, however it is turned now.
bool in_place(const Pose& pose, const Pose& last, std::span<const glm::dvec3> points) {
  const glm::dvec3 middle = middle_of(points);
  const glm::dvec2 d = PoseProjection(pose)(middle) - PoseProjection(last)(middle);
  return std::hypot(d.x, d.y) < 0.3 * last.eye_distance_px() &&
         std::abs(pose.log2_scale - last.log2_scale) < 0.15;
}

/// Of a size the head may have by now, turned so that a face is seen, and in the picture.
bool plausible(const Pose& pose, const Pose& last, const Picture& picture,
               std::span<const glm::dvec3> points) {
  if (std::abs(pose.log2_scale - last.log2_scale) > kSizeChange) return false;
  if (std::max(std::abs(pose.yaw), std::abs(pose.pitch)) > kFarthestTurn) return false;
  const PoseProjection projection(pose);
  const auto inside = std::count_if(points.begin(), points.end(), [&](const glm::dvec3& p) {
    const glm::dvec2 at = projection(p);
    return at.x >= 0 && at.y >= 0 && at.x < picture.width() && at.y < picture.height();
  });
  return static_cast<double>(inside) > kInside * static_cast<double>(points.size());
}

/// What one search asks of each place.
struct Wanted {
  const Picture& picture;
  const HeadTracker& head;
  const Pose& last;
  const HeadVertices& vertices;
  std::vector<glm::dvec3> points;
};

/// Collects finds and knows when one will do.
class Finds {
 public:
  explicit Finds(const Wanted& wanted) : wanted_(wanted), best_{{wanted.last, 0}, false} {}

  void settle(const LevelledFrame& now, const Pose& start) {
    if (best_.believed) return;
    const TrackedPose head = wanted_.head.settle(now, start, wanted_.points);
    if (!plausible(head.pose, wanted_.last, wanted_.picture, wanted_.points)) return;
    const bool stayed = in_place(head.pose, wanted_.last, wanted_.points);
    const bool believed = head.confidence >= (stayed ? FaceSearch::kLostBelow : FaceSearch::kSureFrom);
    if (believed || head.confidence > best_.head.confidence) best_ = {head, believed};
  }

  /// Round a pose, by a grid.
  void search(const LevelledFrame& now, const Pose& round, const Grid& grid) {
    if (best_.believed) return;
    std::vector<Pose> tried;
    for (const TrackedPose& c : look_coarsely(wanted_.head, wanted_.vertices, now, round, grid)) {
      if (tried.size() == kSettled || c.confidence < kWorthSettling) return;
      if (std::any_of(tried.begin(), tried.end(), [&](const Pose& p) { return alike(p, c.pose); })) continue;
      tried.push_back(c.pose);
      settle(now, c.pose);
    }
  }

  [[nodiscard]] const FaceSearch::Find& best() const { return best_; }

 private:
  const Wanted& wanted_;
  FaceSearch::Find best_;
};

/// Where the head was, and around.
void search_around(const Wanted& w, Finds& finds) {
  const WorkFrame frame = WorkFrame::cut(w.picture, w.last.shift, w.head.eye_distance_px(), false);
  if (shows_nothing(frame.luma)) return;
  const LevelledFrame now(frame);
  const auto settle = [&](const Pose& there) {
    if (w.head.correlation(now, there, w.points) > kWorthSettlingThere) finds.settle(now, there);
  };
  settle(w.last);
  // Perhaps it was caught in a turn that is none.
  if (const Pose front = frontal(w.last, w.vertices); !alike(front, w.last)) settle(front);
  finds.search(now, w.last, kAround);
}

/// At each face that the cascade finds.
void search_everywhere(const Wanted& w, const FaceFinder& finder, Finds& finds) {
  if (shows_nothing(view(w.picture.y))) return;
  const double eye = w.last.eye_distance_px(), factor = std::exp2(kSizeChange);
  for (const FoundFace& face : finder.find_of_size(w.picture, eye / factor, eye * factor)) {
    if (finds.best().believed) return;
    const glm::dvec2 across = face.left_eye - face.right_eye;
    Pose there;
    there.shift = 0.5 * (face.left_eye + face.right_eye);
    there.log2_scale = std::log2(across.x);
    const WorkFrame frame = WorkFrame::cut(w.picture, there.shift, w.head.eye_distance_px(), false);
    finds.search(LevelledFrame(frame), there, kAtAFind);
  }
}

}  // namespace

FaceSearch::Find FaceSearch::find(const Picture& picture, const HeadTracker& head, const Pose& last,
                                  const HeadVertices& vertices) {
  const Wanted wanted = {picture, head, last, vertices, head.surface(vertices)};
  Finds finds(wanted);
  search_around(wanted, finds);
  if (lost_pictures_++ % kEverywhereEvery == 1 && !finds.best().believed)
    search_everywhere(wanted, *finder_, finds);
  Find found = finds.best();
  const bool likely = !found.believed && found.head.confidence >= kLostBelow;
  if (likely && suspected_ && in_place(found.head.pose, *suspected_, wanted.points)) found.believed = true;
  suspected_ = likely ? std::optional(found.head.pose) : std::nullopt;
  return found;
}

}  // namespace fbs
