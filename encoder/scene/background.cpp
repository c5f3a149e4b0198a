#include "encoder/scene/background.h"

#include <exception>
#include <system_error>
#include <utility>

namespace fbs {

Background::Background(std::size_t most) : most_(most) {
  if (most == 0) return;
  try {
    thread_ = std::thread([this] { work(); });
  } catch (const std::system_error&) {  // the system has no more threads
    most_ = 0;
  }
}

Background::~Background() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
  }
  added_.notify_one();
  thread_.join();
}

Result<void> Background::add(Task task) {
  if (most_ == 0) return task();
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
  std::unique_lock lock(mutex_);
  done_.wait(lock, [&] { return tasks_.empty(); });
  if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  return std::exchange(result_, {});
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
  }
}

}  // namespace fbs
