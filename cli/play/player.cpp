#include "cli/play/player.h"

#include <algorithm>
#include <opencv2/highgui.hpp>
#include <utility>

#include "cli/display/display_image.h"
#include "cli/display/pattern_overlay.h"

namespace fbs::cli {
namespace {

constexpr int kEscape = 27;
constexpr int kIdleMilliseconds = 50;  ///< between looks whether the window has been closed

}  // namespace

Player::Player(std::string window) : window_(std::move(window)) {
  cv::namedWindow(window_, cv::WINDOW_AUTOSIZE);
}

Result<Player::Leave> Player::show(StreamFile& file) {
  file.decoder().record_patterns();
  paused_ = ended_ = false;
  losses_ = {};
  due_ = Clock::now();
  for (;;) {
    if (auto advanced = advance(file); !advanced) return fail(advanced.error());
    auto wish = wait(file.decoder());
    if (!wish) return fail(wish.error());
    if (*wish == Wish::kQuit) return Leave::kQuit;
    if (*wish == Wish::kRestart) return Leave::kRestart;
  }
}

Result<void> Player::advance(StreamFile& file) {
  StreamDecoder& decoder = file.decoder();
  auto status = losses_.next(file);
  if (!status) return fail(status.error());
  ended_ = *status == DecodeStatus::kEnd;
  if (ended_ && decoder.pictures() == 0)
    return fail(ErrorCode::kInvalidStream, file.name() + ": contains no pictures");
  if (ended_) {
    losses_.finish(file);
    return {};
  }
  Picture picture;
  if (auto drawn = decoder.render(picture); !drawn) return fail(drawn.error());
  image_ = display_image(picture, decoder.format());
  due_ +=
      std::chrono::microseconds(static_cast<std::int64_t>(decoder.duration()) * 1'000'000 / kTicksPerSecond);
  return draw(decoder);
}

Result<void> Player::draw(const StreamDecoder& decoder) {
  if (!shows_patterns_) {
    cv::imshow(window_, image_);
    return {};
  }
  auto overlaid = pattern_overlay(decoder, image_);
  if (!overlaid) return fail(overlaid.error());
  cv::imshow(window_, *overlaid);
  return {};
}

Result<Player::Wish> Player::wait(const StreamDecoder& decoder) {
  for (;;) {
    const int key = cv::waitKey(milliseconds());
    if (cv::getWindowProperty(window_, cv::WND_PROP_VISIBLE) < 1) return Wish::kQuit;
    auto wish = take_key(key, decoder);
    if (!wish || *wish != Wish::kNone) return wish;
    if (is_due()) return Wish::kNext;
  }
}

Result<Player::Wish> Player::take_key(int key, const StreamDecoder& decoder) {
  switch (key) {
    case 'q':
    case kEscape:
      return Wish::kQuit;
    case 'r':
      return Wish::kRestart;
    case ' ':
      paused_ = !paused_;
      due_ = Clock::now();
      return Wish::kNone;
    case '.':
      if (ended_) return Wish::kNone;
      paused_ = true;
      return Wish::kNext;
    case 'p':
      shows_patterns_ = !shows_patterns_;
      if (auto drawn = draw(decoder); !drawn) return fail(drawn.error());
      return Wish::kNone;
    default:
      return Wish::kNone;
  }
}

int Player::milliseconds() const {
  if (paused_ || ended_) return kIdleMilliseconds;
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(due_ - Clock::now()).count();
  return static_cast<int>(std::clamp<long long>(left, 1, 1000));
}

}  // namespace fbs::cli
