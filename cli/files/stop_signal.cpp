#include "cli/files/stop_signal.h"

#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>

namespace fbs {
namespace {

constexpr unsigned kRepeatSeconds = 1;

struct sigaction action_of(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  return action;  // without SA_RESTART: waiting calls return EINTR
}

/// Replaces the action unless the signal is ignored, as it is for background jobs of a shell.
void catch_unless_ignored(int number, void (*handler)(int), struct sigaction& old) {
  sigaction(number, nullptr, &old);
  if (old.sa_handler == SIG_IGN) return;
  const struct sigaction action = action_of(handler);
  sigaction(number, &action, nullptr);
}

void write_text(const char* text) {
  // Nothing can be done about a failure here.
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

}  // namespace

std::atomic<StopSignal*> StopSignal::active = nullptr;

StopSignal::StopSignal(const char* notice)
    : notice_(notice), before_notice_(isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "") {
  assert(active == nullptr);
  active = this;
  const struct sigaction alarm_action = action_of(take_alarm);
  sigaction(SIGALRM, &alarm_action, &old_alarm_);
  catch_unless_ignored(SIGINT, take_stop, old_interrupt_);
  catch_unless_ignored(SIGTERM, take_stop, old_terminate_);
}

StopSignal::~StopSignal() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
  alarm(0);
  sigaction(SIGALRM, &old_alarm_, nullptr);
  active = nullptr;
}

// Both handlers call only what POSIX allows in one: sigaction, alarm and write.
void StopSignal::take_stop(int number) {
  const int saved_errno = errno;
  StopSignal* const stop = active;
  const struct sigaction usual = action_of(SIG_DFL);
  sigaction(SIGINT, &usual, nullptr);
  sigaction(SIGTERM, &usual, nullptr);
  if (stop != nullptr) {
    stop->number_ = number;
    stop->say_notice();
  }
  alarm(kRepeatSeconds);
  errno = saved_errno;
}

void StopSignal::take_alarm(int /*number*/) {
  alarm(kRepeatSeconds);
}

void StopSignal::say_notice() const {
  if (notice_ == nullptr) return;
  write_text(before_notice_);
  write_text(notice_);
  write_text("\n");
}

}  // namespace fbs
