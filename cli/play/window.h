// The player's window, through SDL.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "cli/play/window_fit.h"
#include "common/result.h"

union SDL_Event;

namespace fbs::cli {

/// What the user does.
struct WindowEvent {
  enum class Kind : std::uint8_t {
    kKey,     ///< `key`
    kTurn,    ///< dragged by `x`, `y`
    kTilt,    ///< the same with the right button
    kPlace,   ///< clicked on the time bar at `x`, 0..1
    kRedraw,  ///< the window has to be drawn again
    kClose,
  };
  Kind kind{};
  std::string key;      ///< as in key_map.h
  double x = 0, y = 0;  ///< of a drag: shares of the height of the picture on the screen
};

/// An image over the picture.
struct Panel {
  enum class Place : std::uint8_t { kMiddle, kBottomLeft };
  cv::Mat image;  ///< BGR; made smaller where the window is
  Place place = Place::kMiddle;
};

/// At most one exists at a time. Texts of errors begin "cannot open a window".
class Window {
 public:
  /// @param content  size of what will be shown, in square pixels
  static Result<Window> open(const std::string& title, Size content);

  /// What has been done since the last call; waits for something for so long.
  std::vector<WindowEvent> events(std::chrono::milliseconds patience);
  /// Whether events() would return any. Waits for nothing.
  [[nodiscard]] static bool has_events();

  /// Shows an image with the panels over it.
  /// @param content   its size in square pixels; when it changes, a window that is not full screen does too
  /// @param progress  where the time bar ends, 0..1; negative: there is none
  Result<void> show(const cv::Mat& image, Size content, std::span<const Panel> panels, double progress);

  /// @return whether it fills the screen then
  bool set_full_screen(bool full);
  [[nodiscard]] bool full_screen() const;

 private:
  struct Handles;
  struct Close {
    void operator()(Handles* handles) const;
  };
  Window(std::unique_ptr<Handles, Close> handles, Size content)
      : handles_(std::move(handles)), content_(content) {}

  [[nodiscard]] Size size() const;
  void resize();
  void take(const SDL_Event& event, std::vector<WindowEvent>& out);
  void take_button(const SDL_Event& event, std::vector<WindowEvent>& out);
  void take_motion(const SDL_Event& event, std::vector<WindowEvent>& out);
  Result<void> draw_image(const cv::Mat& image, const Box& box);
  Result<void> draw_panel(const Panel& panel, bool over_bar);
  void draw_bar(double progress);

  std::unique_ptr<Handles, Close> handles_;
  Size content_;
  Box before_full_screen_;  ///< where the window was
  bool on_bar_ = false;     ///< the button went down there, and is still down
};

}  // namespace fbs::cli
