#include "decoder/draw/pictures_ahead.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "common/workers.h"

namespace fbs {

PicturesAhead::PicturesAhead(int threads, const Hooks& hooks)
    : threads_(start_threads({threads, "fbs-draw", hooks}, [this](int) { work(); })) {}

PicturesAhead::~PicturesAhead() {
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
  }
  expected_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void PicturesAhead::expect(std::uint64_t number, std::shared_ptr<const Scene> scene, const State& state) {
  if (number < end_) return;
  end_ = number + 1;
  auto job = std::make_unique<Job>(Job{number, std::move(scene), state});
  {
    const std::lock_guard lock(mutex_);
    job->picture = spare();
    jobs_.push_back(std::move(job));
  }
  expected_.notify_one();
}

Result<Picture> PicturesAhead::take(std::uint64_t number, Renderer& renderer, const Scene& scene,
                                    const State& state) {
  end_ = std::max(end_, number + 1);
  std::unique_lock lock(mutex_);
  forget(number, lock);
  if (jobs_.empty() || jobs_.front()->number != number) {
    Picture out = spare();
    lock.unlock();
    if (auto drawn = renderer.render(scene, state, out); !drawn) return fail(drawn.error());
    return out;
  }
  Job& wanted = *jobs_.front();
  while (wanted.stage != Stage::kDrawn) {
    if (Job* const next = next_expected(); next != nullptr)
      draw(*next, renderer, lock);
    else
      drawn_.wait(lock);
  }
  const std::unique_ptr<Job> done = std::move(jobs_.front());
  jobs_.pop_front();
  lock.unlock();
  if (done->fault) std::rethrow_exception(done->fault);
  if (!done->result) return fail(done->result.error());
  return std::move(done->picture);
}

Picture PicturesAhead::spare() {
  if (spare_.empty()) return {};
  Picture out = std::move(spare_.back());
  spare_.pop_back();
  return out;
}

void PicturesAhead::give_back(Picture picture) {
  const std::lock_guard lock(mutex_);
  spare_.push_back(std::move(picture));
}

void PicturesAhead::forget(std::uint64_t below, std::unique_lock<std::mutex>& lock) {
  while (!jobs_.empty() && jobs_.front()->number < below) {
    drawn_.wait(lock, [&] { return jobs_.front()->stage != Stage::kDrawing; });
    jobs_.pop_front();
  }
}

PicturesAhead::Job* PicturesAhead::next_expected() {
  const auto next = std::find_if(jobs_.begin(), jobs_.end(),
                                 [](const auto& job) { return job->stage == Stage::kExpected; });
  return next != jobs_.end() ? next->get() : nullptr;
}

void PicturesAhead::draw(Job& job, Renderer& renderer, std::unique_lock<std::mutex>& lock) {
  job.stage = Stage::kDrawing;
  lock.unlock();
  try {
    job.result = renderer.render(*job.scene, job.state, job.picture);
  } catch (...) {
    job.fault = std::current_exception();
  }
  lock.lock();
  job.stage = Stage::kDrawn;
  drawn_.notify_all();
}

void PicturesAhead::work() {
  Renderer renderer;
  std::unique_lock lock(mutex_);
  for (;;) {
    Job* next = nullptr;
    expected_.wait(lock, [&] { return stops_ || (next = next_expected()) != nullptr; });
    if (stops_) return;
    draw(*next, renderer, lock);
  }
}

}  // namespace fbs
