#include "encoder/landmarks/landmark_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "encoder/landmarks/place_search.h"

namespace fbs {
namespace {

/// Limits the effect of a stage where there is no face. Radii of the mean shape.
constexpr float kMaxMove = 0.7F;

/// A start, relative to the usual shape.
struct Start {
  glm::vec2 shift;  ///< eye distances
  float scale;
  float roll;  ///< radians
};

/// Detectors err by about as much.
constexpr Start kStarts[] = {{{0, 0}, 1, 0},
                             {{0.12F, 0.08F}, 1.1F, 0.12F},
                             {{-0.12F, 0.08F}, 0.9F, -0.12F},
                             {{0.08F, -0.12F}, 0.9F, 0.12F},
                             {{-0.08F, -0.12F}, 1.1F, -0.12F}};

Shape started(const Shape& usual, const Start& start) {
  const glm::vec2 middle = mean_of(usual), to = middle + start.shift * eye_distance(usual);
  const std::complex<float> turn = std::polar(start.scale, start.roll);
  return PlaneSimilarity{
      turn, std::complex<float>(to.x, to.y) - turn * std::complex<float>(middle.x, middle.y)}(usual);
}

Shape halfway(const Shape& a, const Shape& b) {
  Shape out;
  std::ranges::transform(a, b, out.begin(), [](glm::vec2 p, glm::vec2 q) { return (p + q) / 2.F; });
  return out;
}

/// Median of each coordinate separately.
Shape median_of(const std::vector<Shape>& shapes) {
  Shape out;
  std::vector<float> values(shapes.size());
  const auto median = [&](auto value) {
    std::ranges::transform(shapes, values.begin(), value);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  };
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = {median([k](const Shape& s) { return s[k].x; }), median([k](const Shape& s) { return s[k].y; })};
  return out;
}

/// Mean distance of the shapes' landmarks from one shape's, in its eye distances.
float spread_about(const Shape& middle, const std::vector<Shape>& shapes) {
  float sum = 0;
  for (const Shape& s : shapes)
    for (std::size_t k = 0; k < s.size(); ++k) sum += std::hypot(s[k].x - middle[k].x, s[k].y - middle[k].y);
  const float count = static_cast<float>(shapes.size() * kLandmarkCount);
  return sum / count / std::max(eye_distance(middle), 1.F);
}

}  // namespace

Shape LandmarkSearch::usual_shape(const Shape& mean) {
  constexpr float kMiddle = kPatchSide / 2.F;
  return PlaneSimilarity{kPatchEyeDistance / eye_distance(mean), {kMiddle, kMiddle}}(mean);
}

Shape LandmarkSearch::moved(const LandmarkStage& stage, const Shape& mean, const UprightView& view,
                            const Shape& shape) {
  std::vector<float> descriptor(kDescriptorSize);
  view.describe(shape, descriptor);
  const std::vector<float> amounts = stage.regression(descriptor);
  const PlaneSimilarity to_mean = PlaneSimilarity::between(shape, mean);
  Shape upright = to_mean(shape);
  for (std::size_t k = 0; k < upright.size(); ++k)
    for (int axis = 0; axis < 2; ++axis) {
      const std::size_t n = 2 * k + static_cast<std::size_t>(axis);
      float move = stage.offset[n];
      for (std::size_t m = 0; m < amounts.size(); ++m)
        move += amounts[m] * stage.modes[m * 2 * kLandmarkCount + n];
      upright[k][axis] += std::clamp(move, -kMaxMove, kMaxMove);
    }
  return to_mean.inverse()(upright);
}

LandmarkSearch::Agreement LandmarkSearch::agreement_of(const std::vector<Shape>& ends) {
  Agreement out{median_of(ends)};
  out.spread = spread_about(out.shape, ends);
  return out;
}

LandmarkSearch::Agreement LandmarkSearch::descend(const cv::Mat1b& patch) const {
  const Shape usual = usual_shape(table_.mean);
  std::vector<Shape> ends;
  for (const Start& start : kStarts) {
    Shape shape = started(usual, start);
    for (const LandmarkStage& stage : table_.stages)
      shape = moved(stage, table_.mean, UprightView(patch, shape, table_.mean, stage.look), shape);
    ends.push_back(shape);
  }
  return agreement_of(ends);
}

LandmarkSearch::Agreement LandmarkSearch::descend_together(const cv::Mat1b& patch,
                                                           std::vector<Shape> shapes) const {
  for (const LandmarkStage& stage : table_.stages) {
    const UprightView view(patch, median_of(shapes), table_.mean, stage.look);
    for (Shape& shape : shapes) shape = moved(stage, table_.mean, view, shape);
  }
  return agreement_of(shapes);
}

double LandmarkSearch::believe(const cv::Mat1b& patch, const Agreement& end) const {
  const BeliefTable& belief = table_.belief;
  double odds = belief.spread * std::log(end.spread + kLeastSpread) + belief.offset;
  odds += belief.place * PlaceSearch::score(patch, table_);
  std::vector<float> descriptor(kDescriptorSize);
  for (const BeliefView& view : belief.views) {
    UprightView(patch, end.shape, table_.mean, view.look).describe(end.shape, descriptor);
    odds += view.score(descriptor)[0];
  }
  return 1 / (1 + std::exp(-odds));
}

FoundLandmarks LandmarkSearch::found(const FacePatch& patch, const Agreement& end) const {
  FoundLandmarks out;
  std::ranges::transform(end.shape, out.points.begin(),
                         [&patch](glm::vec2 p) { return patch.to_picture(p); });
  out.belief = believe(patch.luma(), end);
  return out;
}

FoundLandmarks LandmarkSearch::find(const cv::Mat& picture, const FacePlace& place) const {
  const FacePatch patch(picture, place);
  return found(patch, descend(patch.luma()));
}

FoundLandmarks LandmarkSearch::follow(const cv::Mat& picture, const Shape& last) const {
  const FacePatch patch(picture, place_of(last));
  const Shape usual = usual_shape(table_.mean);
  Shape start;
  std::ranges::transform(last, start.begin(), [&patch](glm::vec2 p) { return patch.to_patch(p); });
  const Shape at_rest = PlaneSimilarity::between(usual, start)(usual);
  return found(patch, descend_together(patch.luma(), {start, at_rest, halfway(start, at_rest)}));
}

}  // namespace fbs
