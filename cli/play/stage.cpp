#include "cli/play/stage.h"

#include "cli/display/display_image.h"
#include "cli/display/pattern_overlay.h"
#include "cli/video/colour.h"
#include "decoder/scene/scene_face.h"

namespace fbs::cli {

Result<void> Stage::draw(StreamDecoder& decoder) {
  const Scene& scene = decoder.scene();
  if (pattern && *pattern >= scene.patterns.size()) pattern.reset();  // another scene has fewer
  state_ = decoder.state();
  const SceneGeometry* const face = face_of(scene);
  if (face != nullptr) state_ = edit.applied(state_, face->geometry());
  const bool as_sent = !pattern && (face == nullptr || !edit.any());
  return as_sent ? decoder.render(picture_) : decoder.render_state(state_, pattern, picture_);
}

void Stage::choose_next(const StreamDecoder& decoder, int step) {
  const auto count = static_cast<int>(decoder.scene().patterns.size());
  if (count == 0) return;
  const int first = step > 0 ? 0 : count - 1;
  const int next = pattern ? (static_cast<int>(*pattern) + step + count) % count : first;
  pattern = static_cast<std::size_t>(next);
}

void Stage::draw_lines(cv::Mat& image, const StreamDecoder& decoder, int zoom) const {
  const SceneGeometry* const face = face_of(decoder.scene());
  if (face == nullptr || !(overlays.wire || overlays.snakes)) return;
  const WireFrame& head = face->geometry().wire_frame();
  const ScreenVertices vertices = face->project_vertices(state_);
  if (overlays.wire) draw_wire_frame(image, head, vertices, zoom);
  if (overlays.snakes) draw_contours(image, head, vertices, zoom);
}

Result<cv::Mat> Stage::screen_image(const StreamDecoder& decoder) const {
  cv::Mat image = display_image(picture_, decoder.format());
  // Lines would be tinted as well.
  if (!overlays.patterns) {
    draw_lines(image, decoder, display_zoom(decoder.format()));
    return image;
  }
  auto tinted = pattern_overlay(decoder, {state_, pattern}, image);
  if (tinted) draw_lines(*tinted, decoder, display_zoom(decoder.format()));
  return tinted;
}

Result<Picture> Stage::file_picture(const StreamDecoder& decoder) const {
  if (!overlays.any()) return picture_;
  const VideoFormat& format = decoder.format();
  RgbImage rgb = rgb_from_picture(picture_, format.range, format.matrix, ChannelOrder::kBgr);
  cv::Mat image(rgb.height, rgb.width, CV_8UC3, rgb.samples.data());
  if (overlays.patterns) {
    auto tinted = pattern_tinted(decoder, {state_, pattern}, image);
    if (!tinted) return fail(tinted.error());
    image = *tinted;
  }
  draw_lines(image, decoder, 1);
  return picture_from_rgb({image.data, image.total() * 3}, image.cols, image.rows, format.range,
                          format.matrix, ChannelOrder::kBgr);
}

}  // namespace fbs::cli
