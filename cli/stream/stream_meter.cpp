#include "cli/stream/stream_meter.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "decoder/scene_face.h"

namespace fbs::cli {
namespace {

/// Fills the outline of the face; returns its bounding box, empty without a face in the picture.
cv::Rect draw_face(const SceneGeometry& geometry, const State& state, Plane& mask) {
  std::fill(mask.samples.begin(), mask.samples.end(), std::uint8_t{0});
  const auto vertices = geometry.project_vertices(state);
  std::vector<cv::Point> outline;
  for (const std::uint16_t v : generic_head().outline) {
    const glm::ivec3 p = vertices[v];
    outline.emplace_back(p.x >> kScreenOneLog2, p.y >> kScreenOneLog2);
  }
  cv::Mat image(mask.height, mask.width, CV_8UC1, mask.samples.data());
  cv::fillPoly(image, std::vector<std::vector<cv::Point>>{outline}, 255);
  return cv::boundingRect(outline) & cv::Rect(0, 0, mask.width, mask.height);
}

Plane cut(const Plane& p, const cv::Rect& box) {
  Plane out(box.width, box.height);
  for (int y = 0; y < box.height; ++y) std::copy_n(p.row(box.y + y) + box.x, box.width, out.row(y));
  return out;
}

}  // namespace

void StreamMeter::add() {
  sum_.seconds += static_cast<double>(decoder_.duration()) / kTicksPerSecond;
  ++sum_.pictures;
}

Result<void> StreamMeter::compare(const Picture& source) {
  add();
  if (auto drawn = decoder_.render(drawn_); !drawn) return drawn;
  sum_.frame += squared_error(source.y, drawn_.y);
  if (with_ssim_) sum_.ssim_frame += ssim(source.y, drawn_.y);
  const SceneGeometry* face = face_of(decoder_.scene());
  if (face == nullptr) return {};
  if (mask_.samples.size() != source.y.samples.size()) mask_ = Plane(source.width(), source.height());
  const cv::Rect box = draw_face(*face, decoder_.state(), mask_);
  sum_.face += squared_error(source.y, drawn_.y, mask_);
  if (with_ssim_ && !box.empty()) sum_.ssim_face += ssim(cut(source.y, box), cut(drawn_.y, box));
  return {};
}

Measure StreamMeter::result() const {
  Measure m = sum_;
  m.bytes = decoder_.bytes();
  if (m.pictures > 0) {
    m.ssim_frame /= static_cast<double>(m.pictures);
    m.ssim_face /= static_cast<double>(m.pictures);
  }
  return m;
}

}  // namespace fbs::cli
