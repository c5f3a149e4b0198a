// The picture of the player: what the stream says, what the viewer changes, and what is drawn over it.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <optional>

#include "cli/display/face_overlay.h"
#include "decoder/expression/state_edit.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {

/// What is drawn over the picture.
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
  /// Draws all from this pattern of the scene; none: as the state says.
  std::optional<std::size_t> pattern;
  Overlays overlays;

  /// Draws the face as edited. Must follow every change of `edit`, `pattern` and the decoder's picture.
  Result<void> draw(StreamDecoder& decoder);

  /// Goes to another pattern of the scene, from the last to the first and back.
  void choose_next(const StreamDecoder& decoder, int step);

  /// As it was drawn, without what is over it.
  [[nodiscard]] const Picture& picture() const { return picture_; }

  /// For the screen: enlarged by display_zoom(), with everything over it, the legend of the patterns too.
  [[nodiscard]] Result<cv::Mat> screen_image(const StreamDecoder& decoder) const;

  /// For a file: at the size of the picture, with everything over it but the legend. Sample for sample what
  /// the decoder has drawn where nothing is over it.
  [[nodiscard]] Result<Picture> file_picture(const StreamDecoder& decoder) const;

 private:
  void draw_lines(cv::Mat& image, const StreamDecoder& decoder, int zoom) const;

  Picture picture_;
  State state_;  ///< that it shows
};

}  // namespace fbs::cli
