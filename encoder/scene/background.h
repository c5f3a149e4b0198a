// Runs work in parallel to the caller's.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <utility>

#include "common/result.h"

namespace fbs {

/// One task at a time. The destructor waits for the last.
class Background {
 public:
  /// Waits for the previous task; starts this one unless that failed.
  /// @return failure of the task before
  Result<void> start(std::function<Result<void>()> task) {
    if (auto done = wait(); !done) return done;
    running_ = std::async(std::launch::async, std::move(task));
    return {};
  }

  /// @return failure of the last task, once
  Result<void> wait() { return running_.valid() ? running_.get() : Result<void>{}; }

  [[nodiscard]] bool is_idle() const {
    return !running_.valid() || running_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  }

 private:
  std::future<Result<void>> running_;
};

}  // namespace fbs
