// Runs work in parallel to the caller's.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/hooks.h"
#include "common/result.h"

namespace fbs {

/// Wakes a thread that waits for others to get on.
class Bell {
 public:
  void ring();
  [[nodiscard]] std::uint64_t rings() const;
  /// Waits until it has rung more often than this.
  /// @return false: not until then
  bool wait(std::uint64_t rings, std::chrono::steady_clock::time_point until) const;

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable rung_;
  std::uint64_t rings_ = 0;  // under the mutex
};

/// Tasks that another thread does in their order. After one has failed, none is begun.
class Background {
 public:
  using Task = std::function<Result<void>()>;

  /// @param most  tasks that may wait; 0: the caller does each at once
  /// @param name  of the thread
  explicit Background(std::size_t most, const char* name = "fbs-work", const Hooks& hooks = {});
  /// Drops tasks that have not begun.
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Has the bell ring whenever another thread has done a task.
  void ring(const std::shared_ptr<Bell>& bell);

  /// Waits as long as too many tasks wait.
  /// @return failure of this task or of one before, once
  Result<void> add(Task task);

  /// Waits until all are done.
  /// @return failure of one, once
  Result<void> wait();
  /// The same; a failure stays for add() or wait().
  void settle() const;

  [[nodiscard]] bool is_idle() const;

 private:
  void work();

  std::size_t most_;
  mutable std::mutex mutex_;
  mutable std::condition_variable added_, done_;
  // Under the mutex:
  std::deque<Task> tasks_;  ///< the first is being done
  Result<void> result_{};
  std::exception_ptr fault_{};  ///< thrown instead
  bool stops_ = false;
  std::shared_ptr<Bell> bell_{};     ///< or null
  std::vector<std::thread> thread_;  ///< empty: the caller does all
};

}  // namespace fbs
