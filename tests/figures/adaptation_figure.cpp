#include "encoder/find/adapt.h"
#include "encoder/find/face_finder.h"
#include "encoder/find/found_marks.h"
#include "tests/figures/canvas.h"
#include "tests/figures/figures.h"
#include "tests/figures/sheet.h"

namespace fbs::figures {
namespace {

constexpr int kPanelWidth = 300;  // pixels

/// The generic head, positioned and scaled by the eyes.
std::vector<glm::dvec3> scaled_head(const Pose& pose) {
  const PoseProjection projection(pose);
  std::vector<glm::dvec3> out;
  for (const HeadVertex& v : generic_head().vertices) {
    const glm::dvec3 p(v.position);
    out.emplace_back(projection(p), (projection.matrix * p).z);
  }
  return out;
}

/// The whole head with some margin.
cv::Rect2d head_part(const Pose& pose) {
  const double eye = pose.eye_distance_px();
  return {pose.shift.x - 1.9 * eye, pose.shift.y - 1.9 * eye, 3.8 * eye, 4.4 * eye};
}

}  // namespace

Result<cv::Mat3b> adaptation_figure(const Footage& footage, const Followed& followed) {
  const Picture& picture = footage.pictures.front();
  auto finder = FaceFinder::create();
  if (!finder) return fail(finder.error());
  const auto faces = finder->find(picture);
  if (faces.empty()) return fail(ErrorCode::kNoFace, "no face in the first picture");
  const Marks marks = marks_of(faces.front());
  const auto adapted = adapt_head(marks);
  if (!adapted) return fail(adapted.error());

  const cv::Rect2d part = head_part(adapted->pose) & whole_picture(footage.format);
  const auto canvas = [&] { return Canvas(picture, footage.format, part, kPanelWidth); };
  Canvas marked = canvas(), scaled = canvas(), adjusted = canvas();
  std::vector<glm::dvec2> points;
  for (const auto& p : marks.vertex)
    if (p) points.push_back(*p);
  marked.dots(points, {255, 255, 255}, 3.2);
  marked.dots(points, kMark, 2.4);
  scaled.wire_frame(generic_head(), scaled_head(adapted->pose), kMesh);
  adjusted.wire_frame(generic_head(), followed.head(followed.states.front()), kMesh);
  return sheet({{{canvas().image(), "(a) source"},
                 {marked.image(), "(b) reference points"},
                 {scaled.image(), "(c) scaled wire-frame"},
                 {adjusted.image(), "(d) adapted wire-frame"}}});
}

}  // namespace fbs::figures
