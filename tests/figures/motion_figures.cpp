#include <algorithm>

#include "encoder/track/feature_tracker.h"
#include "tests/figures/canvas.h"
#include "tests/figures/figures.h"
#include "tests/figures/sheet.h"

namespace fbs::figures {
namespace {

constexpr int kPanelWidth = 240;  // pixels

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

/// Sources with snakes in the first row, below them the pictures of the paper's own path and, last, the
/// encoder's defaults.
/// @param captions  of the first row, one for each number
Result<cv::Mat3b> rows(const Footage& footage, const Paths& paths, const std::vector<int>& numbers,
                       const std::vector<std::string>& captions) {
  std::vector<int> ascending = numbers;
  std::sort(ascending.begin(), ascending.end());
  ascending.erase(std::unique(ascending.begin(), ascending.end()), ascending.end());
  const auto paper = decode(paths.paper.stream, ascending), fitted = decode(paths.fitted.stream, ascending);
  if (!paper) return fail(paper.error());
  if (!fitted) return fail(fitted.error());

  std::vector<glm::dvec2> faces;
  for (const int i : numbers) {
    const auto& face = paths.fitted.analysis[static_cast<std::size_t>(i)].vertices;
    faces.insert(faces.end(), face.begin(), face.end());
  }
  const cv::Rect2d part = part_with(faces) & whole_picture(footage.format);
  std::vector<Panel> sources, tracked, fits;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto i = static_cast<std::size_t>(numbers[k]);
    const auto at = static_cast<std::size_t>(std::ranges::find(ascending, numbers[k]) - ascending.begin());
    Canvas source(footage.pictures[i], footage.format, part, kPanelWidth);
    draw_snakes(source, paths.paper.analysis[i]);
    const int column = static_cast<int>(k);
    sources.push_back({source.image(), letter(2 * column) + captions[k]});
    tracked.push_back({Canvas((*paper)[at], footage.format, part, kPanelWidth).image(),
                       letter(2 * column + 1) + "by its contours alone"});
    fits.push_back(
        {Canvas((*fitted)[at], footage.format, part, kPanelWidth).image(), "fitted, patterns chosen"});
  }
  return sheet({sources, tracked, fits});
}

std::string numbered(const char* what, int picture) {
  return std::string(what) + ", picture " + std::to_string(picture);
}

}  // namespace

std::vector<int> mouth_pictures(const Footage& footage, const Paths& paths) {
  return rising(measure(footage, paths.fitted, &FaceMotion::mouth_height), kMouthPictures);
}

Result<cv::Mat3b> mouth_figure(const Footage& footage, const Paths& paths) {
  const auto numbers = mouth_pictures(footage, paths);
  std::vector<std::string> captions;
  captions.reserve(numbers.size());
  for (const int i : numbers) captions.push_back(numbered("source", i));
  return rows(footage, paths, numbers, captions);
}

Result<cv::Mat3b> brow_figure(const Footage& footage, const Paths& paths) {
  auto numbers = rising(measure(footage, paths.fitted, &FaceMotion::brow_raise), 3);
  numbers.push_back(lowest(measure(footage, paths.fitted, &FaceMotion::eye_open)));
  std::vector<std::string> captions = {numbered("brows at rest", numbers[0]), numbered("rising", numbers[1]),
                                       numbered("raised", numbers[2]), numbered("lids lowest", numbers[3])};
  return rows(footage, paths, numbers, captions);
}

}  // namespace fbs::figures
