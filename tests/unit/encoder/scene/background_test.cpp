#include "encoder/scene/background.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace fbs {
namespace {

TEST(Background, RunsBesideTheCaller) {
  std::atomic<bool> go = false;
  Background work;
  EXPECT_TRUE(work.is_idle());
  EXPECT_TRUE(work.start([&]() -> Result<void> {
    while (!go) std::this_thread::yield();
    return {};
  }));
  EXPECT_FALSE(work.is_idle());
  go = true;
  EXPECT_TRUE(work.wait());
  EXPECT_TRUE(work.is_idle());
}

TEST(Background, StartsNothingBehindAFailure) {
  bool ran = false;
  Background work;
  EXPECT_TRUE(work.start([]() -> Result<void> { return fail(ErrorCode::kInternal, "no"); }));
  const auto next = work.start([&]() -> Result<void> {
    ran = true;
    return {};
  });
  ASSERT_FALSE(next);
  EXPECT_EQ(next.error().text, "no");
  EXPECT_TRUE(work.wait()) << "said once";
  EXPECT_FALSE(ran);
}

}  // namespace
}  // namespace fbs
