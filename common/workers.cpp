#include "common/workers.h"

#include <system_error>
#include <utility>

namespace fbs {

Workers::Workers(int count) {
  try {
    for (int k = 1; k < count; ++k) threads_.emplace_back([this, k] { work(k); });
  } catch (const std::system_error&) {  // the system has no more threads
  }
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
  }
  begun_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void Workers::run(int jobs, const Job& job) {
  if (threads_.empty() || jobs <= 1) {
    for (int k = 0; k < jobs; ++k) job(k, 0);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    job_ = &job;
    jobs_ = jobs;
    next_ = 0;
    working_ = static_cast<int>(threads_.size());
    ++call_;
  }
  begun_.notify_all();
  take_jobs(0);
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [&] { return working_ == 0; });
  if (const std::exception_ptr fault = std::exchange(fault_, nullptr)) std::rethrow_exception(fault);
}

void Workers::work(int worker) {
  unsigned seen = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    begun_.wait(lock, [&] { return stops_ || call_ != seen; });
    if (stops_) return;
    seen = call_;
    lock.unlock();
    take_jobs(worker);
    lock.lock();
    if (--working_ == 0) ended_.notify_one();
  }
}

void Workers::take_jobs(int worker) {
  std::unique_lock lock(mutex_);
  while (next_ < jobs_) {
    const int k = next_++;
    lock.unlock();
    try {
      (*job_)(k, worker);
      lock.lock();
    } catch (...) {
      lock.lock();
      fault_ = std::current_exception();
      next_ = jobs_;
    }
  }
}

}  // namespace fbs
