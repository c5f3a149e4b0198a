#include "decoder/draw/pictures_ahead.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "common/workers.h"

namespace fbs {
namespace {

void copy(const Plane& from, const PlaneView& to) {
  for (int y = 0; y < to.height; ++y) std::copy_n(from.row(y), to.width, to.row(y));
}

}  // namespace

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
    if (!spare_.empty()) {
      job->picture = std::move(spare_.back());
      spare_.pop_back();
    }
    jobs_.push_back(std::move(job));
  }
  expected_.notify_one();
}

Result<void> PicturesAhead::draw(std::uint64_t number, Renderer& renderer, const Scene& scene,
                                 const State& state, const PictureView& out) {
  end_ = std::max(end_, number + 1);
  std::unique_lock lock(mutex_);
  forget(number, lock);
  if (jobs_.empty() || jobs_.front()->number != number) {
    lock.unlock();
    return renderer.render(scene, state, out);
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
  if (!done->result) return done->result;
  const Picture& from = done->picture;
  if (from.width() != out.y.width || from.height() != out.y.height) return renderer.render(scene, state, out);
  copy(from.y, out.y);
  copy(from.u, out.u);
  copy(from.v, out.v);
  lock.lock();
  spare_.push_back(std::move(done->picture));
  return {};
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
