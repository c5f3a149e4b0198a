#include "encoder/find/face_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/core.hpp>

#include "common/workers.h"
#include "encoder/image/planes.h"

namespace fbs {
namespace {

/// Two faces are the same when their middles are nearer than this, eye distances.
constexpr double kSameFace = 1;

/// The picture's shorter side over the eye distance. The two smallest sizes are whole steps apart, so that
/// either effort examines a face at the same size.
constexpr double kLargestFaces = 2.2, kSmallestFacesOfAll = 32;
const double kSmallestFaces = kSmallestFacesOfAll / std::pow(PlaceSearch::kSizeStep, 4);

/// Places examined in addition to the number of faces wanted.
constexpr std::size_t kMorePlaces = 7;

/// Scores below which places are not examined; once all wanted faces are found, also how far a place may fall
/// behind the last of them.
constexpr float kWorthLooking = 0.2F, kWorthComparing = 0.6F;

/// Belief from which landmarks are searched again, now around the face as found.
constexpr double kWorthAnotherLook = 0.2;

/// Share of the landmarks that must lie in the picture: somebody who is just coming in must wait.
constexpr double kLeastInside = 0.8;

double share_inside(const FoundLandmarks& found, const Picture& picture) {
  const auto count = std::ranges::count_if(found.points, [&picture](glm::dvec2 p) {
    return p.x >= 0 && p.y >= 0 && p.x < picture.width() && p.y < picture.height();
  });
  return static_cast<double>(count) / kLandmarkCount;
}

FacePlace place_of(const FoundLandmarks& found) {
  Shape shape;
  std::ranges::copy(found.points, shape.begin());
  return fbs::place_of(shape);
}

double shorter_side(const Picture& picture) {
  return std::min(picture.width(), picture.height());
}

bool are_one(const FacePlace& a, const FacePlace& b) {
  const glm::dvec2 d = a.centre - b.centre;
  return std::hypot(d.x, d.y) < kSameFace * std::max(a.eye_distance_px, b.eye_distance_px);
}

/// Adds a face; of several that are the same, the most believed stays.
void add(const FoundFace& face, std::vector<FoundFace>& faces) {
  const auto same =
      std::ranges::find_if(faces, [&](const FoundFace& f) { return are_one(f.place, face.place); });
  if (same == faces.end())
    faces.push_back(face);
  else if (face.landmarks.belief > same->landmarks.belief)
    *same = face;
}

/// Sorts by size times belief, largest first.
void sort(std::vector<FoundFace>& faces) {
  std::ranges::sort(faces, std::greater<>(),
                    [](const FoundFace& f) { return f.place.eye_distance_px * f.landmarks.belief; });
}

}  // namespace

Result<FaceFinder> FaceFinder::create() {
  auto table = load_landmarks();
  if (!table) return fail(table.error());
  return FaceFinder(*table);
}

std::vector<FoundFace> FaceFinder::find(const Picture& picture, std::size_t wanted, Effort effort) const {
  const double side = shorter_side(picture);
  auto faces = find(picture, {side / kSmallestFaces, side / kLargestFaces}, wanted);
  if (faces.size() >= wanted || effort != Effort::kAllSizes) return faces;
  for (const FoundFace& small : find(picture, {side / kSmallestFacesOfAll, side / kSmallestFaces}, wanted))
    add(small, faces);
  sort(faces);
  return faces;
}

std::vector<FoundFace> FaceFinder::find(const Picture& picture, const EyeDistances& sizes,
                                        std::size_t wanted) const {
  const cv::Mat luma = view(picture.y);
  const double small = shorter_side(picture) / kSmallestFaces;
  std::vector<FoundFace> faces;
  float worth_looking = kWorthLooking;
  for (const PlaceSearch::Place& p : places_.find(luma, sizes, wanted + kMorePlaces)) {
    if (p.score < worth_looking) break;
    FoundLandmarks found = landmarks_.find(luma, p.place);
    if (found.belief < kWorthAnotherLook) continue;
    found = landmarks_.find(luma, place_of(found));
    const FoundFace face{found, place_of(found)};
    if (share_inside(found, picture) < kLeastInside) continue;
    if (found.belief < (face.place.eye_distance_px < small ? kBelievedIfSmall : kBelieved)) continue;
    add(face, faces);
    if (faces.size() >= wanted) worth_looking = std::max(worth_looking, kWorthComparing * p.score);
  }
  sort(faces);
  return faces;
}

int FaceFinder::turn_to_upright(const Picture& picture, int threads) const {
  struct Turn {
    cv::RotateFlags way;
    int degrees;
    double belief = 0;
  };
  std::array turns{Turn{cv::ROTATE_90_CLOCKWISE, 90}, Turn{cv::ROTATE_180, 180},
                   Turn{cv::ROTATE_90_COUNTERCLOCKWISE, 270}};
  Workers workers(std::min(threads, static_cast<int>(turns.size())));
  workers.run(static_cast<int>(turns.size()), [&](int k, int) {
    Turn& turn = turns[static_cast<std::size_t>(k)];
    const bool lies = turn.degrees != 180;
    Picture turned;
    turned.y = lies ? Plane(picture.height(), picture.width()) : Plane(picture.width(), picture.height());
    cv::Mat out(turned.height(), turned.width(), CV_8UC1, turned.y.samples.data());
    cv::rotate(view(picture.y), out, turn.way);
    const auto faces = find(turned, 1, Effort::kUsualSizes);
    if (!faces.empty()) turn.belief = faces.front().landmarks.belief;
  });
  const Turn& best = *std::ranges::max_element(turns, {}, &Turn::belief);
  return best.belief >= kClear ? best.degrees : 0;
}

}  // namespace fbs
