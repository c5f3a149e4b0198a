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

/// An action of the user.
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
  double x = 0, y = 0;  ///< of a drag: shares of the picture's height on the screen
};

/// An image over the picture.
struct Panel {
  enum class Place : std::uint8_t { kMiddle, kBottomLeft };
  cv::Mat image;  ///< BGR; reduced if the window is
  Place place = Place::kMiddle;
};

/// At most one exists at a time. Error texts begin "cannot open a window".
class Window {
 public:
  /// @param content  size of what will be shown, in square pixels
  static Result<Window> open(const std::string& title, Size content);

  /// Events since the last call; waits up to `patience` for one.
  std::vector<WindowEvent> events(std::chrono::milliseconds patience);
  /// Whether events() would return any. Does not wait.
  [[nodiscard]] static bool has_events();

  /// Shows an image with the panels over it.
  /// @param content   its size in square pixels; when it changes, so does a window that is not full screen
  /// @param progress  where the time bar ends, 0..1; negative: no bar
  Result<void> show(const cv::Mat& image, Size content, std::span<const Panel> panels, double progress);

  void set_full_screen(bool full);
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
  Box before_full_screen_;  ///< the window's position then
  bool on_bar_ = false;     ///< the button was pressed on the bar and is still down
};

}  // namespace fbs::cli
