#include "training/place_training.h"

#include <algorithm>
#include <cmath>

#include "encoder/landmarks/place_search.h"
#include "training/augmentation.h"
#include "training/cascade_training.h"
#include "training/in_parallel.h"
#include "training/ridge.h"

namespace fbs {
namespace {

constexpr float kPlaceRidge = 2;
constexpr int kRounds = 2;  ///< of learning from mistakes
/// Most mistakes per picture and round: with six, the rarest faces rank lower.
constexpr int kMistakes = 2;

/// As coarse as the search's grid.
constexpr PlaceNoise kGridNoise = {0.1F, 0.08F};

/// Whether a place is between seeing and not seeing the face.
bool is_aside(const FacePlace& place, const FacePlace& face) {
  const glm::dvec2 d = place.centre - face.centre;
  return std::hypot(d.x, d.y) > 0.4 * face.eye_distance_px ||
         std::abs(std::log(place.eye_distance_px / face.eye_distance_px)) > 0.35;
}

class Samples {
 public:
  explicit Samples(const Shape& mean) : mean_(mean) {}

  void add(const cv::Mat1b& patch, bool is_face) {
    patches_.push_back(patch);
    is_face_.push_back(is_face ? 1.F : 0.F);
  }

  [[nodiscard]] PlaceTable fitted() const {
    const auto count = static_cast<Eigen::Index>(patches_.size());
    RowMatrix descriptors(count, kDescriptorSize);
    in_parallel(patches_.size(), [&](std::size_t i) {
      PlaceSearch::describe(patches_[i], mean_,
                            {descriptors.row(static_cast<Eigen::Index>(i)).data(), kDescriptorSize});
    });
    const RowMatrix wanted = Eigen::Map<const RowMatrix>(is_face_.data(), count, 1);
    const LinearMap map = fit_ridge(descriptors, wanted, kPlaceRidge);
    return {quantised(map.weights), map.offset(0)};
  }

 private:
  Shape mean_;
  std::vector<cv::Mat1b> patches_;
  std::vector<float> is_face_;
};

}  // namespace

FacePlace any_place(const FacePicture& face, std::mt19937& random) {
  const auto any = [&random](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  return {{any(0, face.luma.cols), any(0, face.luma.rows)},
          static_cast<double>(eye_distance(face.landmarks)) * std::exp(any(-1.5, 0.9))};
}

std::vector<FacePlace> likeliest(const PlaceSearch& search, const cv::Mat1b& picture, std::size_t count) {
  const double side = std::min(picture.cols, picture.rows);
  std::vector<FacePlace> out;
  for (const auto& found : search.find(picture, {side / 12, side / 2.4}, count)) out.push_back(found.place);
  return out;
}

PlaceTable train_places(const std::vector<FaceCount>& faces, const std::vector<cv::Mat1b>& textures,
                        const Shape& mean, std::mt19937& random) {
  Samples samples(mean);
  for (const auto& [face, times] : faces) {
    const FacePlace truth = place_of(face.landmarks);
    for (int i = 0; i < times; ++i) samples.add(augmented(face, truth, kGridNoise, random).patch, true);
    for (int i = 0; i < 2 * times; ++i)
      if (const FacePlace place = any_place(face, random); is_aside(place, truth))
        samples.add(augmented(face, place, {}, random).patch, false);
  }
  LandmarkTable table;
  table.mean = mean;
  table.places = samples.fitted();
  for (int round = 0; round < kRounds; ++round) {
    const PlaceSearch search(table);
    std::vector<std::vector<FacePlace>> found(faces.size() + textures.size());
    in_parallel(found.size(), [&](std::size_t i) {
      found[i] =
          likeliest(search, i < faces.size() ? faces[i].face.luma : textures[i - faces.size()], kMistakes);
    });
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (const FacePlace& place : found[i])
        if (is_aside(place, place_of(faces[i].face.landmarks)))
          samples.add(augmented(faces[i].face, place, {0.02F, 0.02F}, random).patch, false);
    for (std::size_t i = 0; i < textures.size(); ++i)
      for (const FacePlace& place : found[faces.size() + i])
        samples.add(FacePatch(textures[i], place).luma(), false);
    table.places = samples.fitted();
  }
  return table.places;
}

}  // namespace fbs
