// Threads that draw pictures before they are asked for.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/hooks.h"
#include "common/picture.h"
#include "common/result.h"
#include "decoder/draw/renderer.h"
#include "decoder/scene/scene.h"

namespace fbs {

/// A picture is a function of its scene and state, so that pictures can be drawn side by side. That is nearly
/// as many times faster as there are threads, where threads that share one picture wait for each other.
class PicturesAhead {
 public:
  /// @param threads  besides the caller's, at least 1; fewer if the system has no more
  explicit PicturesAhead(int threads, const Hooks& hooks = {});
  ~PicturesAhead();
  PicturesAhead(const PicturesAhead&) = delete;
  PicturesAhead& operator=(const PicturesAhead&) = delete;

  /// Pictures that are worth expecting.
  [[nodiscard]] std::uint64_t most() const { return kPerThread * (threads_.size() + 1); }

  /// This picture will be asked for. Has no effect if it, or a later one, has been expected before.
  /// @param number  rising with time
  void expect(std::uint64_t number, std::shared_ptr<const Scene> scene, const State& state);

  /// Takes a picture as it was drawn ahead, or draws it; earlier ones are no longer expected. While another
  /// thread draws it, draws later ones.
  /// @param renderer  the caller's
  /// @return errors as of Renderer::render()
  [[nodiscard]] Result<Picture> take(std::uint64_t number, Renderer& renderer, const Scene& scene,
                                     const State& state);
  /// Takes a picture's memory for later ones.
  void give_back(Picture picture);

 private:
  /// The caller's time between pictures and threads' own vary: two each keep all at work.
  static constexpr std::uint64_t kPerThread = 2;

  enum class Stage : std::uint8_t { kExpected, kDrawing, kDrawn };
  struct Job {
    std::uint64_t number;
    std::shared_ptr<const Scene> scene;
    State state;
    Stage stage = Stage::kExpected;
    Picture picture{};
    Result<void> result{};
    std::exception_ptr fault{};  ///< thrown instead
  };

  void work();
  /// Memory for a picture. Under the mutex.
  [[nodiscard]] Picture spare();
  /// The first that nobody draws; null: there is none. Under the mutex.
  [[nodiscard]] Job* next_expected();
  /// @param lock  released meanwhile
  void draw(Job& job, Renderer& renderer, std::unique_lock<std::mutex>& lock);
  /// Removes jobs below a number. Under the mutex.
  void forget(std::uint64_t below, std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable expected_, drawn_;
  // Under the mutex:
  std::deque<std::unique_ptr<Job>> jobs_;  ///< by rising number
  std::vector<Picture> spare_;             ///< memory for later ones
  bool stops_ = false;
  // The caller's alone:
  std::uint64_t end_ = 0;  ///< behind the last picture expected
  std::vector<std::thread> threads_;
};

}  // namespace fbs
