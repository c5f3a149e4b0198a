// step_pictures OUT_FOLDER: draws the steps of the codec on the talker, a PNG each, for
// docs/make_pictures.py. NAME_1.png, NAME_2.png ... stand beside each other there.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "decoder/atlas/atlas_layout.h"
#include "encoder/find/adapt.h"
#include "encoder/find/face_finder.h"
#include "encoder/find/found_marks.h"
#include "tests/figures/canvas.h"
#include "tests/figures/figures.h"

namespace fbs::figures {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kTalkerSeed = 1;
constexpr int kPanelWidth = 276;  // pixels
constexpr int kContrast = 4;      // of a difference
const cv::Scalar kPaper(96, 96, 96);

template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().text);
  return std::move(*result);
}

/// A part of a picture, in eye distances from the origin of the head in it.
struct Part {
  double top, width, height;

  [[nodiscard]] cv::Rect2d at(const Pose& pose) const {
    const double eye = pose.eye_distance_px();
    return {pose.shift.x - width / 2 * eye, pose.shift.y + top * eye, width * eye, height * eye};
  }
};
constexpr Part kHead{-1.8, 3.8, 4.1}, kFace{-0.9, 2.5, 2.7};

/// A talker as the codec follows it.
struct Subject {
  Footage footage;
  Followed followed;

  [[nodiscard]] Canvas canvas(const Picture& picture, const cv::Rect2d& part) const {
    return {picture, footage.format, part, kPanelWidth};
  }
};

using Panels = std::vector<cv::Mat3b>;

/// The landmarks found, and the head laid on them.
Panels adaptation(const Subject& of) {
  const Picture& picture = of.footage.pictures.front();
  const auto faces = must(FaceFinder::create()).find(picture);
  if (faces.empty()) throw std::runtime_error("no face in the first picture");
  std::vector<glm::dvec2> points;
  for (const auto& p : marks_of(faces.front()).vertex)
    if (p) points.push_back(*p);
  const cv::Rect2d part = kHead.at(of.followed.pose(0));
  Canvas found = of.canvas(picture, part), adapted = of.canvas(picture, part);
  found.dots(points, {255, 255, 255}, 3.2);
  found.dots(points, kMark, 2.4);
  adapted.wire_frame(generic_head(), of.followed.head(of.followed.states.front()), kMesh);
  return {of.canvas(picture, part).image(), found.image(), adapted.image()};
}

cv::Mat3b snakes(const Subject& of, int picture) {
  const auto i = static_cast<std::size_t>(picture);
  Canvas canvas = of.canvas(of.footage.pictures[i], kFace.at(of.followed.pose(i)));
  const auto draw = [&](FeatureId id, bool closed, const cv::Scalar& colour) {
    canvas.curve(snake_of(of.followed.analysis[i], id), closed, colour);
  };
  draw(FeatureId::kMouthOuter, true, kOuterLips);
  draw(FeatureId::kMouthInner, true, kInnerLips);
  for (const FeatureId brow : {FeatureId::kBrowRight, FeatureId::kBrowLeft}) draw(brow, false, kBrows);
  for (const FeatureId lid : {FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft}) draw(lid, false, kLids);
  return canvas.image();
}

/// The mouth shut and open, and the eyes shut.
Panels contours(const Subject& of) {
  const auto mouth = rising(measure(of.footage, of.followed, &FaceMotion::mouth_height), 2);
  const int blink = lowest(measure(of.footage, of.followed, &FaceMotion::eye_open));
  return {snakes(of, mouth.front()), snakes(of, mouth.back()), snakes(of, blink)};
}

/// The head of a pattern, laid flat.
cv::Mat3b atlas_panel(const Subject& of, const Pattern& pattern, int height_px) {
  const AtlasLayout& layout = of.followed.scene.geometry->atlas_layout();
  const double width = pattern.atlas.width(), height = pattern.atlas.height();
  const double part_width = height * kPanelWidth / height_px;
  const cv::Rect2d part((width - part_width) / 2, 0, part_width, height);
  cv::Mat3b image = of.canvas(pattern.atlas, part).image();
  const double zoom = kPanelWidth / part.width;
  cv::Mat1b outside(image.size(), 255);
  for (const MeshTriangle& triangle : layout.triangles) {
    std::vector<cv::Point> corners;
    for (const auto k : triangle) {
      const glm::dvec2 p = glm::dvec2(layout.points[static_cast<std::size_t>(k)]) / 64.0;
      corners.emplace_back(cvRound((p.x - part.x) * zoom), cvRound((p.y - part.y) * zoom));
    }
    cv::fillConvexPoly(outside, corners, 0);
  }
  cv::dilate(outside, outside, {});  // where interpolation reads beyond the edge
  cv::dilate(outside, outside, {});
  image.setTo(kPaper, outside);
  return image;
}

double mouth_height(const Subject& of, const Pattern& pattern) {
  const auto vertices = of.followed.head(pattern.seen);
  const glm::dvec3 lips = vertices[vertex_of_landmark(57)] - vertices[vertex_of_landmark(51)];
  return lips.y / pose_of(pattern.seen).eye_distance_px();
}

/// The first pattern, and the one with the widest mouth; each as sent, and its head in the atlas.
Panels patterns(const Subject& of) {
  const PatternList& all = of.followed.scene.patterns;
  const auto open = std::ranges::max_element(all, {}, [&](const Pattern& p) { return mouth_height(of, p); });
  Panels out;
  for (const Pattern& pattern : {all.front(), *open}) {
    out.push_back(of.canvas(pattern.picture, kHead.at(pose_of(pattern.seen))).image());
    out.push_back(atlas_panel(of, pattern, out.back().rows));
  }
  return out;
}

/// Source, mesh as decoded, decoded picture, and the luma difference, mid-grey where there is none.
Panels decoded(const Subject& of) {
  const int picture = rising(measure(of.footage, of.followed, &FaceMotion::mouth_height), 2).back();
  const auto i = static_cast<std::size_t>(picture);
  const cv::Rect2d part = kHead.at(of.followed.pose(i));
  const Picture& source = of.footage.pictures[i];
  const Picture drawn = must(decode(of.followed.stream, {picture})).front();
  Canvas mesh = of.canvas(drawn, part);
  mesh.wire_frame(generic_head(), of.followed.head(of.followed.states[i]), kMesh);
  Picture difference = drawn;
  for (int y = 0; y < source.height(); ++y)
    for (int x = 0; x < source.width(); ++x) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(source.width()) + x;
      const int d = kContrast * (drawn.y.samples[at] - source.y.samples[at]);
      difference.y.samples[at] = static_cast<std::uint8_t>(std::clamp(126 + d, 0, 255));
    }
  std::ranges::fill(difference.u.samples, std::uint8_t{128});
  std::ranges::fill(difference.v.samples, std::uint8_t{128});
  return {of.canvas(source, part).image(), mesh.image(), of.canvas(drawn, part).image(),
          of.canvas(difference, part).image()};
}

void write(const fs::path& folder, const std::string& name, const Panels& panels) {
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const fs::path file = folder / (name + "_" + std::to_string(k + 1) + ".png");
    if (!cv::imwrite(file.string(), panels[k])) throw std::runtime_error("cannot write " + file.string());
  }
}

}  // namespace
}  // namespace fbs::figures

int main(int argc, char** argv) {
  using namespace fbs::figures;
  if (argc != 2) {
    std::fprintf(stderr, "usage: step_pictures OUT_FOLDER\n");
    return 2;
  }
  try {
    const fs::path out = argv[1];
    fs::create_directories(out);
    Footage footage = talker_footage("talker", kTalkerSeed);
    Followed followed = must(follow(footage, {}));
    const Subject talker{std::move(footage), std::move(followed)};
    write(out, "adaptation", adaptation(talker));
    write(out, "contours", contours(talker));
    write(out, "patterns", patterns(talker));
    write(out, "decoded", decoded(talker));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "step_pictures: %s\n", e.what());
    return 1;
  }
}
