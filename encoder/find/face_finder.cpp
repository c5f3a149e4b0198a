#include "encoder/find/face_finder.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "encoder/image/planes.h"

namespace fbs {
namespace {

/// Two faces are one when their middles are nearer than this, eye distances.
constexpr double kSameFace = 1;

FacePlace place_of(const FoundLandmarks& found) {
  Shape shape;
  std::ranges::copy(found.points, shape.begin());
  return fbs::place_of(shape);
}

bool are_one(const FacePlace& a, const FacePlace& b) {
  const glm::dvec2 d = a.centre - b.centre;
  return std::hypot(d.x, d.y) < kSameFace * std::max(a.eye_distance_px, b.eye_distance_px);
}

/// Of those that are one, the most believed stays.
void add(const FoundFace& face, std::vector<FoundFace>& faces) {
  const auto same =
      std::ranges::find_if(faces, [&](const FoundFace& f) { return are_one(f.place, face.place); });
  if (same == faces.end())
    faces.push_back(face);
  else if (face.landmarks.belief > same->landmarks.belief)
    *same = face;
}

}  // namespace

Result<FaceFinder> FaceFinder::create() {
  auto detector = FaceDetector::create();
  if (!detector) return fail(detector.error());
  auto table = load_landmarks();
  if (!table) return fail(table.error());
  return FaceFinder(std::move(*detector), LandmarkSearch(std::move(*table)));
}

std::vector<FoundFace> FaceFinder::find(const Picture& picture, std::size_t wanted, Effort effort) const {
  const cv::Mat luma = view(picture.y);
  std::vector<FoundFace> faces;
  const auto judge = [&](const std::vector<FacePlace>& places, double believed) {
    for (const FacePlace& place : places) {
      const FoundLandmarks found = landmarks_.find(luma, place);
      if (found.belief >= believed) add({found, place_of(found)}, faces);
    }
  };
  judge(detector_.likely(picture), kBelieved);
  if (faces.size() < wanted && effort == Effort::kAllPlaces)
    judge(detector_.possible(picture), kBelievedWherePossible);
  std::ranges::sort(faces, std::greater<>(), [](const FoundFace& f) { return f.place.eye_distance_px; });
  return faces;
}

}  // namespace fbs
