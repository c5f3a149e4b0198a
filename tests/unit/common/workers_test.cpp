#include "common/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace fbs {
namespace {

TEST(Workers, DoEachJobOnce) {
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    for (const int jobs : {0, 1, 2, 7, 100}) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(jobs));
      workers.run(jobs, [&](int k, int) { ++done[k]; });
      for (const auto& d : done) ASSERT_EQ(d, 1) << threads << " threads, " << jobs << " jobs";
    }
  }
}

// A worker's own data needs no lock.
TEST(Workers, NoTwoJobsAtOnceHaveTheSameWorker) {
  Workers workers(4);
  std::vector<std::atomic<int>> busy(static_cast<std::size_t>(workers.count()));
  std::atomic<int> clashes = 0;
  for (int i = 0; i < 200; ++i)
    workers.run(16, [&](int, int worker) {
      if (busy[worker].fetch_add(1) != 0) ++clashes;
      busy[worker].fetch_sub(1);
    });
  EXPECT_EQ(clashes, 0);
}

TEST(Workers, ThrowWhatAJobThrowsAndGoOnAfterwards) {
  for (const int threads : {1, 3}) {
    Workers workers(threads);
    EXPECT_THROW(workers.run(20,
                             [](int k, int) {
                               if (k == 3) throw std::runtime_error("three");
                             }),
                 std::runtime_error);
    std::atomic<int> done = 0;
    workers.run(20, [&](int, int) { ++done; });
    EXPECT_EQ(done, 20);
  }
}

TEST(Workers, OneThreadIsTheCallersOwn) {
  Workers workers(1);
  EXPECT_EQ(workers.count(), 1);
  const auto caller = std::this_thread::get_id();
  workers.run(3, [&](int, int worker) {
    EXPECT_EQ(worker, 0);
    EXPECT_EQ(std::this_thread::get_id(), caller);
  });
}

}  // namespace
}  // namespace fbs
