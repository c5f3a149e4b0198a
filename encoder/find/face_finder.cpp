#include "encoder/find/face_finder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>
#include <optional>

#include "encoder/find/find_tuning.h"
#include "encoder/image/planes.h"

namespace fbs {

using namespace find_tuning;

namespace {

glm::dvec2 centre_of(const cv::Rect& r) {
  return {r.x + r.width / 2.0, r.y + r.height / 2.0};
}

struct EyePair {
  glm::dvec2 right, left;
};

double length(glm::dvec2 v) {
  return std::hypot(v.x, v.y);
}

/// A pair of detections that could be this face's eyes: level, each in its own half, at a plausible distance.
/// The most probable by its distance to where eyes usually are.
std::optional<EyePair> choose_eyes(const std::vector<cv::Rect>& found, cv::Rect face) {
  const glm::dvec2 c = centre_of(face);
  const double size = face.width;
  const glm::dvec2 usual_right = c + glm::dvec2(-kEyeX, kEyeY) * size,
                   usual_left = c + glm::dvec2(kEyeX, kEyeY) * size;
  double least = kMaxEyesOff;
  std::optional<EyePair> best;
  for (const cv::Rect& a : found) {
    for (const cv::Rect& b : found) {
      const glm::dvec2 pa = centre_of(a), pb = centre_of(b), d = pb - pa;
      if (d.x < kMinEyesApart * size || d.x > kMaxEyesApart * size || std::abs(d.y) > kMaxEyesTilt * d.x)
        continue;
      const double cost = (length(pa - usual_right) + length(pb - usual_left)) / size;
      if (cost < least) {
        least = cost;
        best = EyePair{pa, pb};
      }
    }
  }
  return best;
}

/// Detections of one of the eye cascades in the upper half of a face.
std::vector<cv::Rect> detect_eyes(cv::CascadeClassifier& cascade, const cv::Mat& grey, cv::Rect face) {
  const cv::Rect upper(face.x, face.y + face.height / 8, face.width, face.height / 2);
  const cv::Rect area = upper & cv::Rect(0, 0, grey.cols, grey.rows);
  const double zoom = std::max(1.0, kEyeRegionWidth / face.width);
  cv::Mat region;
  cv::resize(grey(area), region, {}, zoom, zoom, cv::INTER_CUBIC);
  std::vector<cv::Rect> eyes;
  const int least = static_cast<int>(face.width * zoom / 9);
  cascade.detectMultiScale(region, eyes, 1.05, 3, 0, {least, least});
  for (cv::Rect& e : eyes)
    e = cv::Rect(static_cast<int>(e.x / zoom) + area.x, static_cast<int>(e.y / zoom) + area.y,
                 static_cast<int>(e.width / zoom), static_cast<int>(e.height / zoom));
  return eyes;
}

/// A face found in a picture scaled by `scale`, its eyes where they usually are.
FoundFace with_usual_eyes(cv::Rect face, double scale) {
  FoundFace found;
  found.centre = centre_of(face) / scale;
  found.size = face.width / scale;
  found.right_eye = found.centre + glm::dvec2(-kEyeX, kEyeY) * found.size;
  found.left_eye = found.centre + glm::dvec2(kEyeX, kEyeY) * found.size;
  return found;
}

void largest_first(std::vector<cv::Rect>& faces) {
  std::sort(faces.begin(), faces.end(),
            [](const cv::Rect& a, const cv::Rect& b) { return a.area() > b.area(); });
}

}  // namespace

struct FaceFinder::Cascades {
  mutable cv::CascadeClassifier face, eye, eye_glasses;
};

void FaceFinder::Deleter::operator()(Cascades* c) const {
  delete c;
}

Result<FaceFinder> FaceFinder::create() {
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
  if (!load(c->face, "haarcascade_frontalface_alt2.xml") || !load(c->eye, "haarcascade_eye.xml") ||
      !load(c->eye_glasses, "haarcascade_eye_tree_eyeglasses.xml"))
    return fail(ErrorCode::kIo, "no Haar cascades in " + folder.string() + " (Debian package opencv-data)");
  return FaceFinder(std::move(c));
}

std::vector<FoundFace> FaceFinder::find(const Picture& picture) const {
  const double scale = std::max(1.0, static_cast<double>(kSearchRows) / picture.height());
  cv::Mat grey;
  cv::resize(view(picture.y), grey, {}, scale, scale, cv::INTER_CUBIC);
  cv::Mat levelled;
  cv::equalizeHist(grey, levelled);

  std::vector<cv::Rect> faces;
  const int smallest = std::max(48, grey.rows / 10);
  for (const cv::Mat* image : {&grey, &levelled}) {
    cascades_->face.detectMultiScale(*image, faces, 1.1, 3, 0, {smallest, smallest});
    if (!faces.empty()) break;
  }
  largest_first(faces);

  std::vector<FoundFace> out;
  for (const cv::Rect& f : faces) {
    FoundFace found = with_usual_eyes(f, scale);
    for (cv::CascadeClassifier* cascade : {&cascades_->eye, &cascades_->eye_glasses}) {
      const auto eyes = choose_eyes(detect_eyes(*cascade, grey, f), f);
      if (!eyes) continue;
      found.right_eye = eyes->right / scale;
      found.left_eye = eyes->left / scale;
      found.eyes_seen = true;
      break;
    }
    out.push_back(found);
  }
  return out;
}

std::vector<FoundFace> FaceFinder::find_of_size(const Picture& picture, double min_eye_distance_px,
                                                double max_eye_distance_px) const {
  const double least = min_eye_distance_px / (2 * kEyeX), most = max_eye_distance_px / (2 * kEyeX);
  const double scale = kMinDetectorSide / least;
  cv::Mat grey;
  cv::resize(view(picture.y), grey, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  const auto square = [&](double side_px) {
    const int side = static_cast<int>(std::lround(side_px * scale));
    return cv::Size(side, side);
  };
  std::vector<cv::Rect> faces;
  cascades_->face.detectMultiScale(grey, faces, 1.1, 3, 0, square(least), square(most));
  largest_first(faces);
  std::vector<FoundFace> out;
  out.reserve(faces.size());
  for (const cv::Rect& f : faces) out.push_back(with_usual_eyes(f, scale));
  return out;
}

}  // namespace fbs
