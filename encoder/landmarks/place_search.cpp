#include "encoder/landmarks/place_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

namespace fbs {
namespace {

/// Pictures are scaled so that faces of the wanted size have eyes this far apart, pixels.
constexpr double kEyeDistance = 12;
constexpr int kStride = 4;  ///< between places, pixels
constexpr float kSigma = 2, kSpotRadius = 5;

/// Margin added around a picture by repeating its border, for faces that reach it: pixels. Contains all of a
/// face's spots.
constexpr int kMargin = 32;

/// Two places are the same face when their middles are nearer than this, eye distances, and the logarithms of
/// their sizes differ by less.
constexpr double kSameMiddle = 0.6, kSameSize = 0.5;

bool are_one(const FacePlace& a, const FacePlace& b) {
  const glm::dvec2 d = a.centre - b.centre;
  return std::hypot(d.x, d.y) < kSameMiddle * std::max(a.eye_distance_px, b.eye_distance_px) &&
         std::abs(std::log(a.eye_distance_px / b.eye_distance_px)) < kSameSize;
}

std::vector<cv::Point> spots_of(const Shape& mean) {
  const float scale = static_cast<float>(kEyeDistance) / eye_distance(mean);
  std::vector<cv::Point> out;
  for (const glm::vec2 landmark : mean)
    for (const glm::vec2 spot : kSpotDirections) {
      const glm::vec2 at = landmark * scale + spot * kSpotRadius;
      const auto pixel = [](float v) {
        return std::clamp(static_cast<int>(std::floor(v)), -kMargin, kMargin - 1);
      };
      out.emplace_back(pixel(at.x), pixel(at.y));
    }
  return out;
}

/// The picture at another scale, with margins.
cv::Mat1f scaled(const cv::Mat& picture, double scale) {
  cv::Mat out;
  cv::resize(picture, out, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::copyMakeBorder(out, out, kMargin, kMargin, kMargin, kMargin, cv::BORDER_REPLICATE);
  out.convertTo(out, CV_32F);
  return cv::Mat1f(out);
}

/// Adds the scores of a row of places, kStride apart.
/// @param middle  of the first place
void add_row(const cv::Mat& maps, const cv::Point& middle, std::span<const cv::Point> spots,
             std::span<const Histogram> weights, std::span<float> scores) {
  for (std::size_t n = 0; n < scores.size(); ++n) {
    const int column = middle.x + kStride * static_cast<int>(n);
    for (std::size_t first = 0; first < spots.size(); first += kSpots) {
      Histogram products = Histogram::all(0), squares = Histogram::all(0);
      for (std::size_t s = first; s < first + kSpots; ++s) {
        const Histogram& seen = maps.at<Histogram>(middle.y + spots[s].y, column + spots[s].x);
        for (int o = 0; o < kOrientations; ++o) {
          products[o] += seen[o] * weights[s][o];
          squares[o] += seen[o] * seen[o];
        }
      }
      float product = 0, square = 0;
      for (int o = 0; o < kOrientations; ++o) {
        product += products[o];
        square += squares[o];
      }
      // scale_to_unit_length() without storing the histograms.
      scores[n] += product * (1 / std::sqrt(square + kNoiseGradient * kNoiseGradient));
    }
  }
}

/// The best place of each face.
std::vector<PlaceSearch::Place> best_of(std::vector<PlaceSearch::Place> places, std::size_t count) {
  std::ranges::sort(places, std::greater<>(), &PlaceSearch::Place::score);
  std::vector<PlaceSearch::Place> best;
  for (const auto& p : places) {
    if (best.size() == count) break;
    if (std::ranges::none_of(best, [&](const auto& b) { return are_one(b.place, p.place); }))
      best.push_back(p);
  }
  return best;
}

}  // namespace

PlaceSearch::PlaceSearch(const LandmarkTable& table)
    : spots_(spots_of(table.mean)), weights_(spots_.size()), offset_(table.places.offset) {
  const DescriptorMap& map = table.places.score;
  for (std::size_t s = 0; s < weights_.size(); ++s)
    for (std::size_t o = 0; o < kOrientations; ++o)
      weights_[s][static_cast<int>(o)] =
          map.scale[0] * static_cast<float>(map.weights[s * kOrientations + o]);
}

std::vector<PlaceSearch::Place> PlaceSearch::find(const cv::Mat& picture, const EyeDistances& sizes,
                                                  std::size_t count) const {
  std::vector<Place> places;
  cv::Mat source = picture;  // no larger than necessary
  double source_scale = 1;
  for (double eye = sizes.least_px; eye <= sizes.most_px; eye *= kSizeStep) {
    const double scale = kEyeDistance / eye;
    const cv::Mat1f luma = scaled(source, scale / source_scale);
    const cv::Mat maps = orientation_maps(luma, kSigma);
    std::vector<float> scores(static_cast<std::size_t>((maps.cols - 2 * kMargin + kStride - 1) / kStride));
    for (int y = kMargin; y < maps.rows - kMargin; y += kStride) {
      std::ranges::fill(scores, offset_);
      add_row(maps, {kMargin, y}, spots_, weights_, scores);
      for (std::size_t n = 0; n < scores.size(); ++n)
        places.push_back({{glm::dvec2(kStride * static_cast<int>(n), y - kMargin) / scale, eye}, scores[n]});
    }
    if (scale < source_scale) {
      source = luma(cv::Rect(kMargin, kMargin, luma.cols - 2 * kMargin, luma.rows - 2 * kMargin));
      source_scale = scale;
    }
  }
  return best_of(std::move(places), count);
}

void PlaceSearch::describe(const cv::Mat1b& patch, const Shape& mean, std::span<float> out) {
  const cv::Mat maps = orientation_maps(scaled(patch, kEyeDistance / kPatchEyeDistance), kSigma);
  const std::vector<cv::Point> spots = spots_of(mean);
  const cv::Point middle(maps.cols / 2, maps.rows / 2);
  auto next = out.begin();
  for (const cv::Point& spot : spots)
    next = std::ranges::copy(maps.at<Histogram>(middle + spot).val, next).out;
  constexpr std::size_t kOfALandmark = kSpots * kOrientations;
  for (std::size_t first = 0; first < out.size(); first += kOfALandmark)
    scale_to_unit_length(out.subspan(first, kOfALandmark));
}

float PlaceSearch::score(const cv::Mat1b& patch, const LandmarkTable& table) {
  std::vector<float> descriptor(kDescriptorSize);
  describe(patch, table.mean, descriptor);
  return table.places.score(descriptor)[0] + table.places.offset;
}

}  // namespace fbs
