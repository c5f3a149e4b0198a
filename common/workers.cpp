#include "common/workers.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

namespace fbs {

int core_count() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));  // 0: unknown
}

std::vector<std::thread> start_threads(const ThreadPlan& plan, const std::function<void(int)>& work) {
  std::vector<std::thread> out;
  out.reserve(static_cast<std::size_t>(std::max(plan.count, 0)));
  const auto begin = [hooks = plan.hooks, name = plan.name, work](int k) {
    if (hooks.thread_start != nullptr) hooks.thread_start(hooks.user, name);
    work(k);
  };
  try {
    for (int k = 0; k < plan.count; ++k) out.emplace_back(begin, k);
  } catch (const std::system_error&) {  // the system has no more threads
    plan.hooks.say(LogLevel::kWarning, "the system gives " + std::to_string(out.size()) + " of " +
                                           std::to_string(plan.count) + " threads " + plan.name);
  }
  return out;
}

Workers::Workers(int count, const Hooks& hooks)
    : threads_(start_threads({count - 1, "fbs-worker", hooks}, [this](int k) { work(1 + k); })) {}

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
  std::unique_lock lock(mutex_);
  job_ = &job;
  jobs_ = jobs;
  next_ = 0;
  begun_.notify_all();
  take_jobs(0, lock);
  // Threads that have not woken up yet find nothing left, and are not waited for.
  ended_.wait(lock, [&] { return running_ == 0; });
  if (const std::exception_ptr fault = std::exchange(fault_, nullptr)) std::rethrow_exception(fault);
}

void Workers::work(int worker) {
  std::unique_lock lock(mutex_);
  for (;;) {
    begun_.wait(lock, [&] { return stops_ || next_ < jobs_; });
    if (stops_) return;
    take_jobs(worker, lock);
  }
}

void Workers::take_jobs(int worker, std::unique_lock<std::mutex>& lock) {
  while (next_ < jobs_) {
    const int k = next_++;
    ++running_;
    lock.unlock();
    std::exception_ptr fault;
    try {
      (*job_)(k, worker);
    } catch (...) {
      fault = std::current_exception();
    }
    lock.lock();
    if (fault) {
      fault_ = fault;
      next_ = jobs_;
    }
    if (--running_ == 0) ended_.notify_one();
  }
}

}  // namespace fbs
