// Ctrl-C and SIGTERM as a request: the verb ends what it does and keeps, or removes, its output.
#pragma once

#include <atomic>
#include <csignal>

namespace fbs {

/// While an object exists, the first SIGINT or SIGTERM only sets a flag; the second ends the program as
/// usual. System calls that wait, such as a read from a pipe, are interrupted (EINTR), and again every second
/// until the object is destroyed: one that began just after the signal ends as well. A signal that was
/// ignored when the object was made stays ignored. At most one object exists at a time. It uses SIGALRM.
class StopSignal {
 public:
  /// @param notice  one line without its newline, written to standard error when the signal comes; must
  /// outlive
  ///                the object; null: nothing is written
  explicit StopSignal(const char* notice);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// SIGINT or SIGTERM; 0 when none has come.
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool raised() const { return number_ != 0; }
  /// "SIGINT" or "SIGTERM".
  [[nodiscard]] const char* name() const { return number_ == SIGTERM ? "SIGTERM" : "SIGINT"; }

 private:
  static void take_stop(int number);
  static void take_alarm(int number);
  void say_notice() const;

  static_assert(std::atomic<int>::is_always_lock_free, "written by a signal handler");
  static std::atomic<StopSignal*> active;

  std::atomic<int> number_ = 0;
  const char* notice_;
  const char* before_notice_;  ///< clears the progress bar of a terminal
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
  struct sigaction old_alarm_ {};
};

}  // namespace fbs
