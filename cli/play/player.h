// A window in which streams are played, and its keys.
#pragma once

#include <chrono>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "cli/stream/loss_report.h"
#include "cli/stream/stream_file.h"

namespace fbs::cli {

/// Throws cv::Exception when the window cannot be opened or drawn into.
class Player {
 public:
  static constexpr const char* kKeys = "space: pause   .: step   p: patterns   r: restart   q: quit";

  /// @param window  its title
  explicit Player(std::string window);

  enum class Leave : std::uint8_t { kQuit, kRestart };
  /// Shows the stream once, then its last picture, until the user leaves. Goes on after damage, and says at
  /// the end on standard error what was lost.
  /// @param file  before its first next()
  Result<Leave> show(StreamFile& file);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Wish : std::uint8_t { kNone, kNext, kQuit, kRestart };

  /// Goes on to the next picture and draws it.
  Result<void> advance(StreamFile& file);
  /// Draws the current picture.
  Result<void> draw(const StreamDecoder& decoder);
  /// Takes keys until the next picture is due or the user wishes something else; never returns kNone.
  Result<Wish> wait(const StreamDecoder& decoder);
  Result<Wish> take_key(int key, const StreamDecoder& decoder);
  /// How long to wait for a key.
  [[nodiscard]] int milliseconds() const;
  [[nodiscard]] bool is_due() const { return !paused_ && !ended_ && Clock::now() >= due_; }

  std::string window_;
  bool shows_patterns_ = false;
  cv::Mat image_;  ///< the current picture, enlarged
  LossReport losses_;
  bool paused_ = false, ended_ = false;
  Clock::time_point due_;  ///< when the next picture is shown
};

}  // namespace fbs::cli
