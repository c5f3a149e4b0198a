#include "cli/program/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "cli/program/report.h"

namespace fbs {
namespace {

constexpr auto kRedrawInterval = std::chrono::milliseconds(100);
constexpr int kUsualColumns = 80;

int terminal_columns() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsualColumns;
  return size.ws_col;
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(std::clamp(seconds, 0.0, 1e9)));
  std::array<char, 48> text{};
  if (whole < 60) {
    std::snprintf(text.data(), text.size(), "%lld s", whole);
  } else if (whole < 3600) {
    std::snprintf(text.data(), text.size(), "%lld:%02lld", whole / 60, whole % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return text.data();
}

std::string progress_text(const std::string& label, const ProgressState& state, int columns) {
  const auto done = static_cast<double>(state.done);
  const double speed = state.seconds > 0 ? done / state.seconds : 0;
  std::array<char, 64> speed_text{};
  std::snprintf(speed_text.data(), speed_text.size(), "  %.1f pictures/s", speed);

  std::string text = label;
  if (state.total && *state.total > 0) {
    const std::int64_t expected = std::max(*state.total, state.done);
    const double all = static_cast<double>(expected) + state.after;
    const double behind = done + std::min(state.passed, state.after);
    std::array<char, 16> percent{};
    std::snprintf(percent.data(), percent.size(), " %3d %%", static_cast<int>(100 * behind / all));
    text += percent.data();
    text += "  " + std::to_string(state.done) + "/" + std::to_string(expected) + speed_text.data();
    if (speed > 0) text += "  " + duration_text((all - behind) / speed) + " left";
  } else {
    text += "  " + std::to_string(state.done) + speed_text.data();
  }
  return text.substr(0, static_cast<std::size_t>(std::max(columns - 1, 0)));
}

Progress::Progress(std::string label, std::optional<std::int64_t> total, bool quiet)
    : label_(std::move(label)),
      total_(total),
      visible_(!quiet && isatty(STDERR_FILENO) == 1),
      begun_(Clock::now()),
      last_told_(begun_),
      last_done_(begun_) {}

Progress::~Progress() {
  finish();
}

void Progress::update(std::int64_t done) {
  if (!visible_ && !reports()) return;
  done_ = done;
  const Clock::time_point now = Clock::now();
  last_done_ = now;
  if (now - last_told_ < kRedrawInterval) return;
  last_told_ = now;
  report_progress(label_, done, total_);
  if (visible_) draw(now, 0);
}

void Progress::wait() {
  using Seconds = std::chrono::duration<double>;
  const Clock::time_point now = Clock::now();
  const double seconds = Seconds(last_done_ - begun_).count();
  if (!visible_ || seconds <= 0) return;
  draw(now, Seconds(now - last_done_).count() * static_cast<double>(done_) / seconds);
}

void Progress::draw(Clock::time_point now, double passed) {
  const double seconds = std::chrono::duration<double>((passed > 0 ? last_done_ : now) - begun_).count();
  const std::string text =
      progress_text(label_, {done_, total_, seconds, after_, passed}, terminal_columns());
  std::fprintf(stderr, "\r\033[K%s", text.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  if (!std::exchange(drawn_, false)) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
}

void Progress::finish() {
  if (const std::int64_t done = std::exchange(done_, 0); done > 0) report_progress(label_, done, total_);
  clear();
  visible_ = false;
}

}  // namespace fbs
