#include "cli/source/face_outline.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "decoder/scene/scene_face.h"

namespace fbs::cli {

FaceOutline face_outline(const StreamDecoder& decoder) {
  FaceOutline out;
  const SceneGeometry* face = face_of(decoder.scene());
  if (face == nullptr) return out;
  const auto vertices = face->project_vertices(decoder.state());
  for (const std::uint16_t v : face->geometry().wire_frame().outline) {
    const glm::ivec3 p = vertices[v];
    out.push_back({p.x >> kScreenOneLog2, p.y >> kScreenOneLog2});
  }
  return out;
}

PixelBox draw_face(const FaceOutline& outline, Plane& mask) {
  std::fill(mask.samples.begin(), mask.samples.end(), std::uint8_t{0});
  if (outline.empty()) return {};
  std::vector<cv::Point> corners;
  for (const OutlinePoint& p : outline) corners.emplace_back(p.x, p.y);
  cv::Mat image(mask.height, mask.width, CV_8UC1, mask.samples.data());
  cv::fillPoly(image, std::vector<std::vector<cv::Point>>{corners}, 255);
  const cv::Rect box = cv::boundingRect(corners) & cv::Rect(0, 0, mask.width, mask.height);
  return {box.x, box.y, box.width, box.height};
}

}  // namespace fbs::cli
