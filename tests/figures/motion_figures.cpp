#include <algorithm>

#include "encoder/track/feature_tracker.h"
#include "tests/figures/canvas.h"
#include "tests/figures/figures.h"
#include "tests/figures/sheet.h"

namespace fbs::figures {
namespace {

constexpr int kPanelWidth = 240;  // pixels

/// What all chosen pictures show of the face, so that its motion is seen against the panels' borders.
cv::Rect2d face_part(const Followed& followed, const std::vector<int>& numbers, const cv::Rect2d& whole) {
  glm::dvec2 low(1e9), high(-1e9);
  for (const int i : numbers) {
    for (const glm::dvec2 p : followed.analysis[i].vertices) {
      low = glm::dvec2(std::min(low.x, p.x), std::min(low.y, p.y));
      high = glm::dvec2(std::max(high.x, p.x), std::max(high.y, p.y));
    }
  }
  const glm::dvec2 margin = 0.06 * (high - low);
  const cv::Rect2d part(low.x - margin.x, low.y - margin.y, high.x - low.x + 2 * margin.x,
                        high.y - low.y + 2 * margin.y);
  return part & whole;
}

void draw_snakes(Canvas& canvas, const PictureAnalysis& analysis) {
  for (std::size_t s = 0; s < kSnakeFeatures.size(); ++s) {
    const FeatureId id = kSnakeFeatures[s];
    const bool brow = id == FeatureId::kBrowRight || id == FeatureId::kBrowLeft;
    const cv::Scalar& colour = id == FeatureId::kMouthOuter   ? kOuterLips
                               : id == FeatureId::kMouthInner ? kInnerLips
                               : brow                         ? kBrows
                                                              : kLids;
    canvas.curve(analysis.snakes[s].points, analysis.snakes[s].closed, colour, 1);
  }
}

/// Sources with snakes in the upper row, decoded pictures in the lower.
/// @param captions  of the upper row, one for each number
Result<cv::Mat3b> pairs(const Footage& footage, const Followed& followed, const std::vector<int>& numbers,
                        const std::vector<std::string>& captions) {
  std::vector<int> ascending = numbers;
  std::sort(ascending.begin(), ascending.end());
  ascending.erase(std::unique(ascending.begin(), ascending.end()), ascending.end());
  const auto decoded = decode(followed.stream, ascending);
  if (!decoded) return fail(decoded.error());

  const cv::Rect2d part = face_part(followed, numbers, whole_picture(footage.format));
  std::vector<Panel> above, below;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto i = static_cast<std::size_t>(numbers[k]);
    const auto at = std::find(ascending.begin(), ascending.end(), numbers[k]) - ascending.begin();
    Canvas source(footage.pictures[i], footage.format, part, kPanelWidth);
    draw_snakes(source, followed.analysis[i]);
    const Canvas synthesised((*decoded)[at], footage.format, part, kPanelWidth);
    const int column = static_cast<int>(k);
    above.push_back({source.image(), letter(2 * column) + captions[k]});
    below.push_back({synthesised.image(), letter(2 * column + 1) + "synthesised"});
  }
  return sheet({above, below});
}

std::string numbered(const char* what, int picture) {
  return std::string(what) + ", picture " + std::to_string(picture);
}

}  // namespace

Result<cv::Mat3b> mouth_figure(const Footage& footage, const Followed& followed) {
  const auto numbers = rising(measure(footage, followed, &FaceMotion::mouth_height), 4);
  std::vector<std::string> captions;
  for (const int i : numbers) captions.push_back(numbered("source", i));
  return pairs(footage, followed, numbers, captions);
}

Result<cv::Mat3b> brow_figure(const Footage& footage, const Followed& followed) {
  auto numbers = rising(measure(footage, followed, &FaceMotion::brow_raise), 3);
  numbers.push_back(lowest(measure(footage, followed, &FaceMotion::eye_open)));
  std::vector<std::string> captions = {numbered("brows at rest", numbers[0]), numbered("rising", numbers[1]),
                                       numbered("raised", numbers[2]), numbered("lids lowest", numbers[3])};
  return pairs(footage, followed, numbers, captions);
}

}  // namespace fbs::figures
