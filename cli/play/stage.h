// The player's picture: the stream's, with the viewer's changes and overlays.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>

#include "cli/display/face_overlay.h"
#include "decoder/expression/state_edit.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {

/// Overlays over the picture.
struct Overlays {
  bool wire = false;
  bool snakes = false;
  bool patterns = false;
  [[nodiscard]] bool any() const { return wire || snakes || patterns; }
};

/// Draws the current picture of a decoder.
class Stage {
 public:
  StateEdit edit;
  /// Draws everything from this pattern of the scene; none: as the state says.
  std::optional<std::size_t> pattern;
  Overlays overlays;

  /// Draws the face as edited. Must follow every change of `edit`, `pattern` and the decoder's picture.
  Result<void> draw(StreamDecoder& decoder);

  /// Selects another pattern of the scene, cyclically.
  void choose_next(const StreamDecoder& decoder, int step);

  /// For the screen: enlarged by display_zoom(), with all overlays and the legend of the patterns.
  [[nodiscard]] Result<cv::Mat> screen_image(const StreamDecoder& decoder) const;

  /// For a file: at the picture's size, with all overlays except the legend. Without overlays, sample for
  /// sample what the decoder has drawn.
  [[nodiscard]] Result<Picture> file_picture(const StreamDecoder& decoder) const;

 private:
  void draw_lines(cv::Mat& image, const StreamDecoder& decoder, int zoom) const;

  Picture picture_;
  State state_;  ///< state of picture_
};

}  // namespace fbs::cli
