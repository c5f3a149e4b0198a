#include "encoder/track/landmark_follow.h"

#include "encoder/find/face_finder.h"

namespace fbs {
namespace {

Shape projected(const PoseProjection& projection, const HeadVertices& vertices) {
  Shape out;
  for (int k = 0; k < kLandmarkCount; ++k)
    out[static_cast<std::size_t>(k)] = glm::vec2(projection(vertices[vertex_of_landmark(k)]));
  return out;
}

}  // namespace

LandmarkFollow::LandmarkFollow(const LandmarkSearch* search, const Geometry& geometry, const Pose& pose,
                               const cv::Mat& first)
    : search_(search), geometry_(geometry), expression_(geometry), expression_by_given_(geometry) {
  if (const auto found = search_landmarks(first, pose, Offsets{}))
    expression_.calibrate(*found, pose, Offsets{});
}

std::optional<LandmarkPoints> LandmarkFollow::search_landmarks(const cv::Mat& picture, const Pose& pose,
                                                               const Offsets& before) const {
  if (search_ == nullptr) return std::nullopt;
  const FoundLandmarks found =
      search_->follow(picture, projected(PoseProjection(pose), skinned(geometry_, before)));
  if (found.belief < FaceFinder::kBelieved) return std::nullopt;
  return found.points;
}

std::optional<Offsets> LandmarkFollow::find(const cv::Mat& picture, const Pose& pose,
                                            const Offsets& before) const {
  const auto found = search_landmarks(picture, pose, before);
  if (!found) return std::nullopt;
  return expression_.offsets(*found, pose);
}

std::optional<Offsets> LandmarkFollow::by_given(const Pose& pose) const {
  if (!given_ || !expression_by_given_.is_calibrated()) return std::nullopt;
  return expression_by_given_.offsets(*given_, pose);
}

void LandmarkFollow::end_picture(const Fit* seen) {
  if (given_ && seen != nullptr && !expression_by_given_.is_calibrated())
    expression_by_given_.calibrate(*given_, seen->pose, seen->offsets);
  given_.reset();
}

}  // namespace fbs
