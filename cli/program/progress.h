// Progress on standard error: percent, pictures per second and time left.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace fbs {

/// One line of standard error, redrawn in place at most ten times a second. Draws nothing when standard error
/// is not a terminal or `quiet` is set; finish() and the destructor clear the line. The same goes to
/// cli/program/report.h.
class Progress {
 public:
  /// @param label   the activity, such as "encoding"
  /// @param total   expected pictures; without it only count and speed are shown
  Progress(std::string label, std::optional<std::int64_t> total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param done  pictures finished so far; may exceed the total, which is only an estimate
  void update(std::int64_t done);

  /// What follows the last picture takes as long as so many of them: it counts for percent and time left.
  void expect_after(double pictures) { after_ = pictures; }

  /// Draws the line while something other than pictures is waited for, whose end is estimated.
  void wait();

  /// Whether the line is drawn at all.
  [[nodiscard]] bool visible() const { return visible_; }

  /// Clears the line until the next update: something else is to be printed.
  void clear();

  /// Clears the line. Calling it again does nothing.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  /// @param passed  of what follows the last picture, as pictures
  void draw(Clock::time_point now, double passed);

  std::string label_;
  std::optional<std::int64_t> total_;
  bool visible_;
  bool drawn_ = false;
  std::int64_t done_ = 0;  ///< not told of yet, perhaps
  double after_ = 0;       ///< pictures
  Clock::time_point begun_;
  Clock::time_point last_told_;
  Clock::time_point last_done_;
};

/// What a line of progress says.
struct ProgressState {
  std::int64_t done = 0;
  std::optional<std::int64_t> total;
  double seconds = 0;  ///< that the pictures have taken
  double after = 0;    ///< Progress::expect_after()
  double passed = 0;   ///< of `after`
};

/// The text of the line, without control characters: "encoding  42 %  123/300  51.2 pictures/s  3 s left".
/// @param columns  width of the terminal; the text is cut to fit
std::string progress_text(const std::string& label, const ProgressState& state, int columns);

/// "7 s", "2:05" or "1:02:05".
std::string duration_text(double seconds);

}  // namespace fbs
