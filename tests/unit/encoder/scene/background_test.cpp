#include "encoder/scene/background.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace fbs {
namespace {

Result<void> failed() {
  return fail(ErrorCode::kInternal, "no");
}

TEST(Background, RunsBesideTheCaller) {
  std::atomic<bool> go = false;
  Background work(1);
  EXPECT_TRUE(work.is_idle());
  EXPECT_TRUE(work.add([&]() -> Result<void> {
    while (!go) std::this_thread::yield();
    return {};
  }));
  EXPECT_FALSE(work.is_idle());
  go = true;
  EXPECT_TRUE(work.wait());
  EXPECT_TRUE(work.is_idle());
}

TEST(Background, DoesAllInOrder) {
  for (const std::size_t most : {0, 1, 7}) {
    std::vector<int> done;
    Background work(most);
    for (int k = 0; k < 100; ++k)
      ASSERT_TRUE(work.add([&done, k]() -> Result<void> {
        done.push_back(k);
        return {};
      }));
    EXPECT_TRUE(work.wait());
    ASSERT_EQ(done.size(), 100U);
    for (int k = 0; k < 100; ++k) EXPECT_EQ(done[k], k);
  }
}

TEST(Background, FailuresAreSaidOnceAndDropWhatWaits) {
  std::atomic<bool> go = false, ran = false;
  Background work(4);
  EXPECT_TRUE(work.add([&] {
    while (!go) std::this_thread::yield();
    return failed();
  }));
  EXPECT_TRUE(work.add([&]() -> Result<void> {
    ran = true;
    return {};
  }));
  go = true;
  const auto waited = work.wait();
  ASSERT_FALSE(waited);
  EXPECT_EQ(waited.error().text, "no");
  EXPECT_TRUE(work.wait()) << "said once";
  EXPECT_FALSE(ran);
}

TEST(Background, SettlingKeepsTheFailure) {
  Background work(1);
  EXPECT_TRUE(work.add(failed));
  work.settle();
  EXPECT_TRUE(work.is_idle());
  EXPECT_FALSE(work.wait());
}

TEST(Background, TheCallersOwnTasksFailAtOnce) {
  Background work(0);
  EXPECT_FALSE(work.add(failed));
  EXPECT_TRUE(work.is_idle());
}

TEST(Background, ExceptionsReachTheCaller) {
  Background work(1);
  EXPECT_TRUE(work.add([]() -> Result<void> { throw std::runtime_error("thrown"); }));
  EXPECT_THROW((void)work.wait(), std::runtime_error);
}

TEST(Background, RingsWhenATaskIsDoneWhateverItsResult) {
  const auto bell = std::make_shared<Bell>();
  const auto past = std::chrono::steady_clock::now();
  EXPECT_FALSE(bell->wait(0, past));
  Background work(1);
  work.ring(bell);
  EXPECT_TRUE(work.add([]() -> Result<void> { return {}; }));
  EXPECT_TRUE(bell->wait(0, past + std::chrono::minutes(10)));
  EXPECT_TRUE(work.add(failed));
  EXPECT_TRUE(bell->wait(1, past + std::chrono::minutes(10)));
  EXPECT_EQ(bell->rings(), 2U);
  EXPECT_TRUE(bell->wait(1, past)) << "it has rung before";
}

TEST(Background, EndsWithTasksThatWait) {
  Background work(4);
  for (int k = 0; k < 4; ++k) EXPECT_TRUE(work.add([]() -> Result<void> { return {}; }));
}

}  // namespace
}  // namespace fbs
