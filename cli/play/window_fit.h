// Sizes and places in the player's window. Pixels of the screen; knows no window.
#pragma once

#include "common/picture.h"

namespace fbs::cli {

struct Size {
  int width = 0, height = 0;
  friend bool operator==(const Size&, const Size&) = default;
};

struct Box {
  int x = 0, y = 0, width = 0, height = 0;
  friend bool operator==(const Box&, const Box&) = default;
};

/// Size in square pixels of an image whose pixels have another aspect; no side becomes smaller.
/// @param aspect  width of a pixel over its height; 0/1 and what is beyond 1/8 .. 8 is taken for 1
[[nodiscard]] Size square_pixels(Size image, Rational aspect);

/// The image as large as it is, or smaller by one factor where it would exceed `room`.
[[nodiscard]] Size shrunk_to(Size image, Size room);

/// Where the image lies in a window: as large as it fits, in the middle.
[[nodiscard]] Box letterbox(Size image, Size window);

inline constexpr int kBarHeight = 6;        ///< of the time bar, at the bottom of the window
inline constexpr int kBarClickHeight = 18;  ///< where a click is one on the bar

/// The place on the time bar, 0..1, of a click; negative: it is not on the bar.
[[nodiscard]] double place_on_bar(int x, int y, Size window);

}  // namespace fbs::cli
