#include "encoder/find/face_finder.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/objdetect.hpp>

#include "encoder/image/planes.h"

namespace fbs {
namespace {

constexpr int kSearchRows = 480;

// Where eyes lie in the detector's square, measured as the median over the faces it finds.
constexpr double kEyeX = 0.19, kEyeY = -0.115;

glm::dvec2 centre_of(const cv::Rect& r) {
  return {r.x + r.width / 2.0, r.y + r.height / 2.0};
}

/// A pair of detections that could be this face's eyes: level within 20 degrees, each in its own half, at a
/// plausible distance. The most probable by its distance to where eyes usually are.
bool choose_eyes(const std::vector<cv::Rect>& found, cv::Rect face, glm::dvec2& right, glm::dvec2& left) {
  const glm::dvec2 c = centre_of(face);
  const double size = face.width;
  const glm::dvec2 usual_right = c + glm::dvec2(-kEyeX, kEyeY) * size,
                   usual_left = c + glm::dvec2(kEyeX, kEyeY) * size;
  double best = 0.25;  // of the face's size, both distances together
  bool got = false;
  for (const cv::Rect& a : found) {
    for (const cv::Rect& b : found) {
      const glm::dvec2 pa = centre_of(a), pb = centre_of(b), d = pb - pa;
      if (d.x < 0.25 * size || d.x > 0.6 * size || std::abs(d.y) > 0.36 * d.x) continue;
      const auto length = [](glm::dvec2 v) { return std::hypot(v.x, v.y); };
      const double cost = (length(pa - usual_right) + length(pb - usual_left)) / size;
      if (cost < best) {
        best = cost;
        right = pa;
        left = pb;
        got = true;
      }
    }
  }
  return got;
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
  const char* set = std::getenv("FBS_CASCADES");
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
    const cv::Rect upper(f.x, f.y + f.height / 8, f.width, f.height / 2);
    const cv::Rect eyes_area = upper & cv::Rect(0, 0, grey.cols, grey.rows);
    glm::dvec2 right, left;
    // The eyes' cascades want eyes of 20 pixels or more.
    const double zoom = std::max(1.0, 160.0 / f.width);
    cv::Mat region;
    cv::resize(grey(eyes_area), region, {}, zoom, zoom, cv::INTER_CUBIC);
    for (const cv::CascadeClassifier* cascade : {&cascades_->eye, &cascades_->eye_glasses}) {
      std::vector<cv::Rect> eyes;
      const int least = static_cast<int>(f.width * zoom / 9);
      const_cast<cv::CascadeClassifier*>(cascade)->detectMultiScale(region, eyes, 1.05, 3, 0, {least, least});
      for (cv::Rect& e : eyes)
        e = cv::Rect(static_cast<int>(e.x / zoom) + eyes_area.x, static_cast<int>(e.y / zoom) + eyes_area.y,
                     static_cast<int>(e.width / zoom), static_cast<int>(e.height / zoom));
      if (choose_eyes(eyes, f, right, left)) {
        found.right_eye = right / scale;
        found.left_eye = left / scale;
        found.eyes_seen = true;
        break;
      }
    }
    out.push_back(found);
  }
  return out;
}

std::vector<FoundFace> FaceFinder::find_of_size(const Picture& picture, double least_eye_distance_px,
                                                double most_eye_distance_px) const {
  constexpr double kLeastSide = 40;  // of the detector's square: twice what it was trained with
  const double least = least_eye_distance_px / (2 * kEyeX), most = most_eye_distance_px / (2 * kEyeX);
  const double scale = kLeastSide / least;
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
  for (const cv::Rect& f : faces) out.push_back(with_usual_eyes(f, scale));
  return out;
}

}  // namespace fbs
