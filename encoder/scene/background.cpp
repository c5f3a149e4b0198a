#include "encoder/scene/background.h"

#include <exception>
#include <utility>

#include "common/workers.h"

namespace fbs {

void Bell::ring() {
  {
    const std::lock_guard lock(mutex_);
    ++rings_;
  }
  rung_.notify_all();
}

std::uint64_t Bell::rings() const {
  const std::lock_guard lock(mutex_);
  return rings_;
}

bool Bell::wait(std::uint64_t rings, std::chrono::steady_clock::time_point until) const {
  std::unique_lock lock(mutex_);
  return rung_.wait_until(lock, until, [&] { return rings_ > rings; });
}

Background::Background(std::size_t most, const char* name, const Hooks& hooks)
    : most_(most), thread_(start_threads({most > 0 ? 1 : 0, name, hooks}, [this](int) { work(); })) {}

Background::~Background() {
  if (thread_.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
  }
  added_.notify_one();
  thread_.front().join();
}

void Background::ring(const std::shared_ptr<Bell>& bell) {
  const std::lock_guard lock(mutex_);
  bell_ = bell;
}

Result<void> Background::add(Task task) {
  if (thread_.empty()) return task();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return tasks_.size() <= most_; });
  if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  if (!result_) return std::exchange(result_, {});
  tasks_.push_back(std::move(task));
  lock.unlock();
  added_.notify_one();
  return {};
}

Result<void> Background::wait() {
  settle();
  const std::lock_guard lock(mutex_);
  if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  return std::exchange(result_, {});
}

void Background::settle() const {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return tasks_.empty(); });
}

bool Background::is_idle() const {
  const std::lock_guard lock(mutex_);
  return tasks_.empty();
}

void Background::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    added_.wait(lock, [&] { return stops_ || !tasks_.empty(); });
    if (stops_) return;
    const Task task = std::move(tasks_.front());
    lock.unlock();
    Result<void> result;
    std::exception_ptr fault;
    try {
      result = task();
    } catch (...) {
      fault = std::current_exception();
    }
    lock.lock();
    if (result && !fault) {
      tasks_.pop_front();
    } else {
      result_ = std::move(result);
      fault_ = fault;
      tasks_.clear();
    }
    done_.notify_all();
    if (bell_) bell_->ring();
  }
}

}  // namespace fbs
