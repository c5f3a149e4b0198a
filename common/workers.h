// Threads that share work.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "common/hooks.h"

namespace fbs {

/// Cores that this process may use, at least 1.
[[nodiscard]] int core_count();

/// The threads to be started for a purpose.
struct ThreadPlan {
  int count;
  const char* name;  ///< for Hooks::thread_start
  Hooks hooks;
};

/// Starts threads, fewer if the system has no more, which is logged.
/// @param work  called once by each, with its number from 0
[[nodiscard]] std::vector<std::thread> start_threads(const ThreadPlan& plan,
                                                     const std::function<void(int)>& work);

class Workers {
 public:
  /// @param count  threads, at least 1: the one that calls run(), and others as far as the system permits
  explicit Workers(int count = 1, const Hooks& hooks = {});
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  [[nodiscard]] int count() const { return 1 + static_cast<int>(threads_.size()); }

  /// Calls job(k, worker) once for each k in 0..jobs - 1, in any order, and returns when all are done. Jobs
  /// that run at the same time have different workers, 0..count() - 1. Rethrows one exception if jobs throw.
  using Job = std::function<void(int k, int worker)>;
  void run(int jobs, const Job& job);

 private:
  void work(int worker);
  /// Does jobs of the current call until none is left to begin.
  void take_jobs(int worker, std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable begun_, ended_;
  // The current call; all under the mutex.
  const Job* job_ = nullptr;
  int jobs_ = 0, next_ = 0;
  int running_ = 0;  ///< jobs that have begun and not ended
  std::exception_ptr fault_;
  bool stops_ = false;
  std::vector<std::thread> threads_;  ///< last: they use the rest
};

}  // namespace fbs
