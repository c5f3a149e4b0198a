// Sizes and positions in the player's window. Pixels of the screen; independent of the window.
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

/// Size in square pixels of an image whose pixels have another aspect; no side shrinks.
/// @param aspect  width of a pixel over its height; 0/1 and values beyond 1/8 .. 8 count as 1
[[nodiscard]] Size square_pixels(Size image, Rational aspect);

/// The image's size, reduced by one factor if it exceeds `room`.
[[nodiscard]] Size shrunk_to(Size image, Size room);

/// Position of the image in a window: as large as it fits, centred.
[[nodiscard]] Box letterbox(Size image, Size window);

inline constexpr int kBarHeight = 6;        ///< of the time bar, at the bottom of the window
inline constexpr int kBarClickHeight = 18;  ///< height in which a click counts as one on the bar

/// The position of a click on the time bar, 0..1; negative: not on the bar.
[[nodiscard]] double place_on_bar(int x, int y, Size window);

}  // namespace fbs::cli
