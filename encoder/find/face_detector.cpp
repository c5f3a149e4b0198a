#include "encoder/find/face_detector.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <utility>

#include "encoder/image/planes.h"

namespace fbs {
namespace {

/// The detector's square about a face: medians over 140 strangers.
constexpr double kSquareSide = 2.67;         ///< eye distances
constexpr double kCentreBelowSquare = 0.11;  ///< of the mean landmark below the square's centre, of its side

/// By which a picture is enlarged on all sides, of its height, repeating its border: a face that fills a
/// picture leaves no room for the square.
constexpr double kMargin = 0.3;

constexpr int kLikelyRows = 240, kPossibleRows = 480;  ///< to which pictures are scaled
constexpr int kSmallestSide = 40;  ///< pixels of the square: twice what the cascades were trained with

FacePlace place_of(const cv::Rect2d& square) {
  return {{square.x + square.width / 2, square.y + square.height * (0.5 + kCentreBelowSquare)},
          square.width / kSquareSide};
}

/// A picture as the cascades see it, and back.
struct Search {
  cv::Mat grey;
  double scale;
  int margin;

  Search(const Picture& picture, double to_scale, double margin_share) : scale(to_scale) {
    cv::resize(view(picture.y), grey, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
    margin = static_cast<int>(margin_share * grey.rows);
    cv::copyMakeBorder(grey, grey, margin, margin, margin, margin, cv::BORDER_REPLICATE);
  }

  [[nodiscard]] FacePlace place(const cv::Rect& r) const {
    return place_of({(r.x - margin) / scale, (r.y - margin) / scale, r.width / scale, r.height / scale});
  }

  [[nodiscard]] std::vector<FacePlace> places(const std::vector<cv::Rect>& found) const {
    std::vector<FacePlace> out(found.size());
    std::ranges::transform(found, out.begin(), [this](const cv::Rect& r) { return place(r); });
    return out;
  }
};

}  // namespace

struct FaceDetector::Cascades {
  mutable cv::CascadeClassifier frontal, other_frontal, profile;
};

void FaceDetector::Deleter::operator()(Cascades* c) const {
  delete c;
}

Result<FaceDetector> FaceDetector::create() {
  // Read once, before any thread of ours could change the environment.
  const char* set = std::getenv("FBS_CASCADES");  // NOLINT(concurrency-mt-unsafe)
  const std::filesystem::path folder = set != nullptr ? set : "/usr/share/opencv4/haarcascades";
  std::unique_ptr<Cascades, Deleter> c(new Cascades);
  const auto load = [&](cv::CascadeClassifier& cascade, const char* name) {
    try {
      return cascade.load((folder / name).string());
    } catch (const cv::Exception&) {
      return false;
    }
  };
  if (!load(c->frontal, "haarcascade_frontalface_alt2.xml") ||
      !load(c->other_frontal, "haarcascade_frontalface_default.xml") ||
      !load(c->profile, "haarcascade_profileface.xml"))
    return fail(ErrorCode::kIo, "no Haar cascades in " + folder.string() + " (Debian package opencv-data)");
  return FaceDetector(std::move(c));
}

std::vector<FacePlace> FaceDetector::likely(const Picture& picture) const {
  const Search search(picture, static_cast<double>(kLikelyRows) / picture.height(), kMargin);
  std::vector<cv::Rect> found;
  cascades_->frontal.detectMultiScale(search.grey, found, 1.1, 3, 0, {kSmallestSide, kSmallestSide});
  return search.places(found);
}

std::vector<FacePlace> FaceDetector::possible(const Picture& picture) const {
  const Search search(picture, static_cast<double>(kPossibleRows) / picture.height(), kMargin);
  cv::Mat levelled, mirrored;
  cv::equalizeHist(search.grey, levelled);
  cv::flip(search.grey, mirrored, 1);
  std::vector<FacePlace> out;
  const auto add = [&](cv::CascadeClassifier& cascade, const cv::Mat& grey, bool is_mirrored) {
    std::vector<cv::Rect> found;
    cascade.detectMultiScale(grey, found, 1.1, 1, 0, {kSmallestSide, kSmallestSide});
    for (cv::Rect r : found) {
      if (is_mirrored) r.x = grey.cols - r.x - r.width;
      out.push_back(search.place(r));
    }
  };
  add(cascades_->frontal, search.grey, false);
  add(cascades_->frontal, levelled, false);
  add(cascades_->other_frontal, search.grey, false);
  add(cascades_->profile, search.grey, false);
  add(cascades_->profile, mirrored, true);
  return out;
}

std::vector<FacePlace> FaceDetector::of_size(const Picture& picture, double min_eye_distance_px,
                                             double max_eye_distance_px) const {
  const double least = min_eye_distance_px * kSquareSide, most = max_eye_distance_px * kSquareSide;
  const Search search(picture, kSmallestSide / least, 0);
  const auto square = [&](double side_px) {
    const int side = static_cast<int>(std::lround(side_px * search.scale));
    return cv::Size(side, side);
  };
  std::vector<cv::Rect> found;
  cascades_->frontal.detectMultiScale(search.grey, found, 1.1, 3, 0, square(least), square(most));
  return search.places(found);
}

}  // namespace fbs
