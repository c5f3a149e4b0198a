#include "cli/play/window.h"

#include <SDL.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace fbs::cli {
namespace {

constexpr int kTitleBar = 32;  ///< pixels left free for the window manager's frame
constexpr Size kSmallest{160, 120};
constexpr std::uint8_t kPanelOpacity = 215;

bool is_set(const char* name) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): no thread changes the environment
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

Error no_window(std::string reason = SDL_GetError()) {
  std::ranges::replace(reason, '\n', ' ');
  return {ErrorCode::kIo, "cannot open a window: " + reason};
}

/// Prevents SDL from falling back to drivers that show nothing, after libraries have printed why others fail.
Result<void> choose_driver() {
  if (is_set("SDL_VIDEODRIVER")) return {};
  std::string drivers;
  if (is_set("DISPLAY")) drivers = "x11";
  if (is_set("WAYLAND_DISPLAY")) drivers += drivers.empty() ? "wayland" : ",wayland";
  if (drivers.empty()) return fail(no_window("no display"));
  SDL_SetHint(SDL_HINT_VIDEODRIVER, drivers.c_str());
  return {};
}

/// The usable part of the screen that the window is on.
Size room_on_screen(int display) {
  SDL_Rect usable{0, 0, 1024, 768};
  SDL_GetDisplayUsableBounds(std::max(display, 0), &usable);
  return {usable.w, usable.h - kTitleBar};
}

std::string key_name(const SDL_Keysym& key) {
  std::string name = SDL_GetKeyName(key.sym);
  if (name.size() == 1) name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
  if ((key.mod & KMOD_SHIFT) != 0) name = "Shift+" + name;
  if ((key.mod & KMOD_CTRL) != 0) name = "Ctrl+" + name;
  return name;
}

struct DestroyTexture {
  void operator()(SDL_Texture* texture) const { SDL_DestroyTexture(texture); }
};
using Texture = std::unique_ptr<SDL_Texture, DestroyTexture>;

}  // namespace

struct Window::Handles {
  SDL_Window* window = nullptr;
  SDL_Renderer* renderer = nullptr;
  Texture image;
  Size image_size;

  [[nodiscard]] Texture texture_of(const cv::Mat& pixels) const {
    Texture texture(SDL_CreateTexture(renderer, SDL_PIXELFORMAT_BGR24, SDL_TEXTUREACCESS_STREAMING,
                                      pixels.cols, pixels.rows));
    if (texture) SDL_UpdateTexture(texture.get(), nullptr, pixels.data, static_cast<int>(pixels.step));
    return texture;
  }
};

void Window::Close::operator()(Handles* handles) const {
  handles->image.reset();
  if (handles->renderer != nullptr) SDL_DestroyRenderer(handles->renderer);
  if (handles->window != nullptr) SDL_DestroyWindow(handles->window);
  delete handles;
  SDL_QuitSubSystem(SDL_INIT_VIDEO);
}

Result<Window> Window::open(const std::string& title, Size content) {
  if (auto chosen = choose_driver(); !chosen) return fail(chosen.error());
  SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "linear");
  SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
  if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) return fail(no_window());
  std::unique_ptr<Handles, Close> handles(new Handles);
  const Size size = shrunk_to(content, room_on_screen(0));
  handles->window = SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                     size.width, size.height, SDL_WINDOW_RESIZABLE);
  if (handles->window == nullptr) return fail(no_window());
  SDL_SetWindowMinimumSize(handles->window, kSmallest.width, kSmallest.height);
  handles->renderer = SDL_CreateRenderer(handles->window, -1, 0);
  if (handles->renderer == nullptr)
    handles->renderer = SDL_CreateRenderer(handles->window, -1, SDL_RENDERER_SOFTWARE);
  if (handles->renderer == nullptr) return fail(no_window());
  return Window(std::move(handles), content);
}

bool Window::has_events() {
  SDL_PumpEvents();
  return SDL_HasEvents(SDL_FIRSTEVENT, SDL_LASTEVENT) == SDL_TRUE;
}

std::vector<WindowEvent> Window::events(std::chrono::milliseconds patience) {
  std::vector<WindowEvent> out;
  SDL_Event event;
  const auto wait = static_cast<int>(patience.count());
  for (int found = SDL_WaitEventTimeout(&event, wait); found != 0; found = SDL_PollEvent(&event))
    take(event, out);
  return out;
}

void Window::take(const SDL_Event& event, std::vector<WindowEvent>& out) {
  using Kind = WindowEvent::Kind;
  switch (event.type) {
    case SDL_QUIT:
      out.push_back({Kind::kClose, {}});
      break;
    case SDL_KEYDOWN:
      out.push_back({Kind::kKey, key_name(event.key.keysym)});
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
      take_button(event, out);
      break;
    case SDL_MOUSEMOTION:
      take_motion(event, out);
      break;
    case SDL_WINDOWEVENT:
      out.push_back({Kind::kRedraw, {}});
      break;
    default:
      break;
  }
}

void Window::take_button(const SDL_Event& event, std::vector<WindowEvent>& out) {
  if (event.button.button != SDL_BUTTON_LEFT) return;
  on_bar_ = false;
  if (event.type != SDL_MOUSEBUTTONDOWN) return;
  const double place = place_on_bar(event.button.x, event.button.y, size());
  on_bar_ = place >= 0;
  if (on_bar_) out.push_back({WindowEvent::Kind::kPlace, {}, place});
}

void Window::take_motion(const SDL_Event& event, std::vector<WindowEvent>& out) {
  const SDL_MouseMotionEvent& motion = event.motion;
  if (on_bar_) {
    const Size window = size();
    out.push_back({WindowEvent::Kind::kPlace, {}, place_on_bar(motion.x, window.height, window)});
    return;
  }
  const bool left = (motion.state & SDL_BUTTON_LMASK) != 0, right = (motion.state & SDL_BUTTON_RMASK) != 0;
  if (!left && !right) return;
  const double height = letterbox(content_, size()).height;
  out.push_back({left ? WindowEvent::Kind::kTurn : WindowEvent::Kind::kTilt,
                 {},
                 motion.xrel / height,
                 motion.yrel / height});
}

Size Window::size() const {
  Size out;
  SDL_GetWindowSize(handles_->window, &out.width, &out.height);
  return out;
}

bool Window::full_screen() const {
  return (SDL_GetWindowFlags(handles_->window) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0;
}

void Window::set_full_screen(bool full) {
  if (full == full_screen()) return;
  SDL_Window* const window = handles_->window;
  Box& before = before_full_screen_;
  // SDL leaves the size to the window manager. Without one, the window sets it itself.
  if (full) {
    SDL_GetWindowPosition(window, &before.x, &before.y);
    SDL_GetWindowSize(window, &before.width, &before.height);
    SDL_Rect screen;
    if (SDL_GetDisplayBounds(std::max(SDL_GetWindowDisplayIndex(window), 0), &screen) == 0) {
      SDL_SetWindowPosition(window, screen.x, screen.y);
      SDL_SetWindowSize(window, screen.w, screen.h);
    }
  }
  SDL_SetWindowFullscreen(window, full ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
  if (!full) {
    SDL_SetWindowSize(window, before.width, before.height);
    SDL_SetWindowPosition(window, before.x, before.y);
  }
}

void Window::resize() {
  if (full_screen()) return;
  const Size wanted = shrunk_to(content_, room_on_screen(SDL_GetWindowDisplayIndex(handles_->window)));
  SDL_SetWindowSize(handles_->window, wanted.width, wanted.height);
  SDL_SetWindowPosition(handles_->window, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED);
}

Result<void> Window::show(const cv::Mat& image, Size content, std::span<const Panel> panels,
                          double progress) {
  if (content != content_) {
    content_ = content;
    resize();
  }
  SDL_SetRenderDrawColor(handles_->renderer, 0, 0, 0, SDL_ALPHA_OPAQUE);
  SDL_RenderClear(handles_->renderer);
  if (auto drawn = draw_image(image, letterbox(content_, size())); !drawn) return drawn;
  for (const Panel& panel : panels)
    if (auto drawn = draw_panel(panel, progress >= 0); !drawn) return drawn;
  if (progress >= 0) draw_bar(progress);
  SDL_RenderPresent(handles_->renderer);
  return {};
}

Result<void> Window::draw_image(const cv::Mat& image, const Box& box) {
  const Size size{image.cols, image.rows};
  if (!handles_->image || handles_->image_size != size) {
    handles_->image = handles_->texture_of(image);
    handles_->image_size = size;
    if (!handles_->image) return fail(no_window());
  } else {
    SDL_UpdateTexture(handles_->image.get(), nullptr, image.data, static_cast<int>(image.step));
  }
  const SDL_Rect target{box.x, box.y, box.width, box.height};
  SDL_RenderCopy(handles_->renderer, handles_->image.get(), nullptr, &target);
  return {};
}

Result<void> Window::draw_panel(const Panel& panel, bool over_bar) {
  const Texture texture = handles_->texture_of(panel.image);
  if (!texture) return fail(no_window());
  const Size window = size(), room{window.width, window.height - (over_bar ? kBarHeight : 0)};
  const Size fitted = shrunk_to({panel.image.cols, panel.image.rows}, room);
  SDL_Rect target{0, room.height - fitted.height, fitted.width, fitted.height};
  if (panel.place == Panel::Place::kMiddle) {
    target.x = (room.width - fitted.width) / 2;
    target.y = (room.height - fitted.height) / 2;
  }
  SDL_SetTextureBlendMode(texture.get(), SDL_BLENDMODE_BLEND);
  SDL_SetTextureAlphaMod(texture.get(), kPanelOpacity);
  SDL_RenderCopy(handles_->renderer, texture.get(), nullptr, &target);
  return {};
}

void Window::draw_bar(double progress) {
  const Size window = size();
  const SDL_Rect whole{0, window.height - kBarHeight, window.width, kBarHeight};
  const SDL_Rect gone{0, whole.y, static_cast<int>(window.width * std::min(progress, 1.0)), kBarHeight};
  SDL_SetRenderDrawColor(handles_->renderer, 50, 50, 50, SDL_ALPHA_OPAQUE);
  SDL_RenderFillRect(handles_->renderer, &whole);
  SDL_SetRenderDrawColor(handles_->renderer, 255, 170, 60, SDL_ALPHA_OPAQUE);
  SDL_RenderFillRect(handles_->renderer, &gone);
}

}  // namespace fbs::cli
