#include "encoder/track/face_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <span>

#include "common/ibug.h"
#include "encoder/image/planes.h"
#include "encoder/track/head/coarse_search.h"
#include "encoder/track/head/pose_alignment.h"

namespace fbs {

using namespace head_tuning;

namespace {

constexpr std::array kYaw = {-30 * kDegree, -15 * kDegree, 0.0, 15 * kDegree, 30 * kDegree};
constexpr std::array kPitch = {-15 * kDegree, 0.0, 15 * kDegree};
constexpr std::array kSize = {-0.15, 0.0, 0.15};  // log2
// A found face is placed better than the last pose places one that moves.
constexpr PoseGrid kGridAround = {kYaw, kPitch, kSize, 1.0};
constexpr PoseGrid kGridAtFace = {kYaw, kPitch, kSize, 0.4};

/// Number of faces among which the head is sought.
constexpr std::size_t kFacesEverywhere = 2;

bool shows_nothing(const cv::Mat& luma) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(luma, mean, deviation);
  return deviation[0] < kFlatDeviation;
}

/// Whether two poses are so near that both refine to the same.
bool alike(const Pose& a, const Pose& b) {
  const glm::dvec2 d = a.shift - b.shift;
  return std::hypot(d.x, d.y) < kSamePlace * a.eye_distance_px() && std::abs(a.yaw - b.yaw) < kSameTurn &&
         std::abs(a.pitch - b.pitch) < kSameTurn;
}

glm::dvec3 middle_of(std::span<const glm::dvec3> points) {
  return std::accumulate(points.begin(), points.end(), glm::dvec3(0)) / static_cast<double>(points.size());
}

/// Whether a head has stayed in place, however it is turned now.
bool in_place(const Pose& pose, const Pose& last, std::span<const glm::dvec3> points) {
  const glm::dvec3 middle = middle_of(points);
  const glm::dvec2 d = PoseProjection(pose)(middle) - PoseProjection(last)(middle);
  return std::hypot(d.x, d.y) < kStayedPlace * last.eye_distance_px() &&
         std::abs(pose.log2_scale - last.log2_scale) < kStayedSize;
}

/// Whether a pose shows its face, and lies in the picture.
bool plausible(const Pose& pose, const Picture& picture, std::span<const glm::dvec3> points) {
  if (std::max(std::abs(pose.yaw), std::abs(pose.pitch)) > kMaxTurn) return false;
  const PoseProjection projection(pose);
  const auto inside = std::count_if(points.begin(), points.end(), [&](const glm::dvec3& p) {
    const glm::dvec2 at = projection(p);
    return at.x >= 0 && at.y >= 0 && at.x < picture.width() && at.y < picture.height();
  });
  return static_cast<double>(inside) > kMinInside * static_cast<double>(points.size());
}

/// The search in one picture.
struct Wanted {
  const Picture& picture;
  const HeadAppearance& head;
  const Pose& last;
  const HeadVertices& vertices;
  double size_change;  ///< most that the head may have by now, log2 against the last pose
  std::vector<glm::dvec3> points;
};

/// Keeps the best detection, and stops at the first accepted.
class Detections {
 public:
  explicit Detections(const Wanted& wanted) : wanted_(wanted), best_{{wanted.last, 0}, false} {}

  /// Refines from a pose that is nearly right.
  void refine(const LevelledFrame& now, const Pose& start) {
    if (best_.accepted) return;
    const TrackedPose head = fbs::refine(wanted_.head, now, start, wanted_.points);
    if (std::abs(head.pose.log2_scale - wanted_.last.log2_scale) > wanted_.size_change) return;
    if (!plausible(head.pose, wanted_.picture, wanted_.points)) return;
    const bool stayed = in_place(head.pose, wanted_.last, wanted_.points);
    const bool accepted = head.confidence >= (stayed ? kLostBelow : kSureFrom);
    if (accepted || head.confidence > best_.head.confidence) best_ = {head, accepted};
  }

  /// Searches a grid around a pose.
  void search(const LevelledFrame& now, const Pose& centre, const PoseGrid& grid) {
    if (best_.accepted) return;
    std::vector<Pose> tried;
    for (const TrackedPose& c : search_coarsely(wanted_.head, wanted_.vertices, now, centre, grid)) {
      if (tried.size() == kRefinedCandidates || c.confidence < kWorthRefining) return;
      if (std::any_of(tried.begin(), tried.end(), [&](const Pose& p) { return alike(p, c.pose); })) continue;
      tried.push_back(c.pose);
      refine(now, c.pose);
    }
  }

  [[nodiscard]] const FaceSearch::Detection& best() const { return best_; }

 private:
  const Wanted& wanted_;
  FaceSearch::Detection best_;
};

/// Searches where the head was, and around.
void search_around(const Wanted& w, Detections& detections) {
  const WorkFrame frame = WorkFrame::cut(w.picture, w.last.shift, w.head.eye_distance_px(), false);
  if (shows_nothing(frame.luma)) return;
  const LevelledFrame now(frame);
  const auto refine_at = [&](const Pose& there) {
    if (w.head.correlation(now, there, w.points) > kWorthRefiningInPlace) detections.refine(now, there);
  };
  refine_at(w.last);
  // The tracker may have been stuck at a wrong yaw or pitch.
  if (const Pose front = frontal(w.last, w.vertices); !alike(front, w.last)) refine_at(front);
  detections.search(now, w.last, kGridAround);
}

/// The upright pose with the face's eyes.
Pose pose_of(const FoundFace& face) {
  const auto eyes = std::span(face.landmarks.points).subspan(ibug::kEyesFirst, 2 * ibug::kEyePoints);
  Pose pose;
  pose.shift = std::accumulate(eyes.begin(), eyes.end(), glm::dvec2(0)) / static_cast<double>(eyes.size());
  pose.log2_scale = std::log2(face.place.eye_distance_px);
  return pose;
}

/// Searches at each face found.
void search_everywhere(const Wanted& w, const FaceFinder& finder, Detections& detections) {
  if (shows_nothing(view(w.picture.y))) return;
  const double eye = w.last.eye_distance_px(), factor = std::exp2(w.size_change);
  for (const FoundFace& face : finder.find(w.picture, {eye / factor, eye * factor}, kFacesEverywhere)) {
    if (detections.best().accepted) return;
    const Pose there = pose_of(face);
    const WorkFrame frame = WorkFrame::cut(w.picture, there.shift, there.eye_distance_px(), false);
    detections.search(LevelledFrame(frame), there, kGridAtFace);
  }
}

}  // namespace

FaceSearch::Detection FaceSearch::find_anywhere(const Picture& picture, const HeadTracker& head,
                                                const Pose& last, const HeadVertices& vertices,
                                                double size_change) const {
  const Wanted wanted = {picture,  head.appearance(), last,
                         vertices, size_change,       head.appearance().surface(vertices)};
  Detections detections(wanted);
  search_everywhere(wanted, *finder_, detections);
  return detections.best();
}

FaceSearch::Detection FaceSearch::find(const Picture& picture, const HeadTracker& head, const Pose& last,
                                       const HeadVertices& vertices) {
  const Wanted wanted = {picture,  head.appearance(), last,
                         vertices, kMaxSizeChange,    head.appearance().surface(vertices)};
  Detections detections(wanted);
  search_around(wanted, detections);
  if (lost_pictures_++ % kEverywherePeriod == 1 && !detections.best().accepted)
    search_everywhere(wanted, *finder_, detections);
  Detection found = detections.best();
  // Accept what is likely in two consecutive pictures at one place.
  const bool likely = !found.accepted && found.head.confidence >= kLostBelow;
  if (likely && suspected_ && in_place(found.head.pose, *suspected_, wanted.points)) found.accepted = true;
  suspected_ = likely ? std::optional(found.head.pose) : std::nullopt;
  return found;
}

}  // namespace fbs
