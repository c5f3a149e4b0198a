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

  /// Clears the line until the next update: something else is to be printed.
  void clear();

  /// Clears the line. Calling it again does nothing.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void draw(Clock::time_point now);

  std::string label_;
  std::optional<std::int64_t> total_;
  bool visible_;
  bool drawn_ = false;
  std::int64_t done_ = 0;  ///< not told of yet, perhaps
  Clock::time_point begun_;
  Clock::time_point last_told_;
};

/// The text of the line, without control characters: "encoding  42 %  123/300  51.2 pictures/s  3 s left".
/// @param columns  width of the terminal; the text is cut to fit
std::string progress_text(const std::string& label, std::int64_t done, std::optional<std::int64_t> total,
                          double seconds, int columns);

}  // namespace fbs
