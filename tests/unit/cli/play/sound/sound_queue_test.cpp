#include "cli/play/sound/sound_queue.h"

#include <gtest/gtest.h>

#include <numeric>

namespace fbs::cli {
namespace {

using namespace std::chrono_literals;

constexpr int kRate = 48000;
constexpr int kBlock = 960;  ///< 20 ms
constexpr std::int64_t kMs = kRate / 1000;
const SoundQueue::Time kStart{100s};

std::vector<std::int16_t> ramp(int count, int first = 1) {
  std::vector<std::int16_t> out(static_cast<std::size_t>(count));
  std::iota(out.begin(), out.end(), static_cast<std::int16_t>(first));
  return out;
}

/// A device that fetches a block each 20 ms; the first one at kStart.
class Device {
 public:
  explicit Device(SoundQueue& queue) : queue_(queue) {}
  std::vector<std::int16_t> fetch() {
    std::vector<std::int16_t> block(static_cast<std::size_t>(kBlock * queue_.channels()));
    queue_.fetch(block, kStart + blocks_++ * 20ms);
    return block;
  }
  void fetch(int blocks) {
    for (int k = 0; k < blocks; ++k) fetch();
  }

 private:
  SoundQueue& queue_;
  int blocks_ = 0;
};

TEST(SoundQueue, GivesWhatWasAddedThenSilence) {
  SoundQueue queue(kRate, 1);
  Device device(queue);
  queue.add(ramp(kBlock + 2));
  EXPECT_EQ(device.fetch(), ramp(kBlock));
  const auto rest = device.fetch();
  EXPECT_EQ(rest[0], kBlock + 1);
  EXPECT_EQ(rest[1], kBlock + 2);
  EXPECT_EQ(std::count(rest.begin() + 2, rest.end(), 0), kBlock - 2);
}

TEST(SoundQueue, BlockIsHeardWhenTheNextIsFetched) {
  SoundQueue queue(kRate, 1);
  Device device(queue);
  queue.restart(7000);
  queue.add(ramp(10 * kBlock));
  EXPECT_EQ(queue.heard(kStart - 1s), 7000);
  device.fetch();
  EXPECT_EQ(queue.heard(kStart + 20ms), 7000);
  device.fetch();
  EXPECT_EQ(queue.heard(kStart + 20ms), 7000);
  EXPECT_EQ(queue.heard(kStart + 25ms), 7000 + 5 * kMs);
  device.fetch();
  EXPECT_EQ(queue.heard(kStart + 50ms), 7000 + 30 * kMs);
}

TEST(SoundQueue, ClockStandsStillWhenTheDeviceDoes) {
  SoundQueue queue(kRate, 1);
  Device device(queue);
  queue.add(ramp(10 * kBlock));
  device.fetch(3);
  EXPECT_EQ(queue.heard(kStart + 10s), 40 * kMs);
}

TEST(SoundQueue, ClockWaitsForSoundThatIsLate) {
  SoundQueue queue(kRate, 1);
  Device device(queue);
  queue.add(ramp(kBlock));
  device.fetch(10);
  EXPECT_EQ(queue.heard(kStart + 190ms), 20 * kMs);
  queue.add(ramp(4 * kBlock));
  device.fetch();
  EXPECT_EQ(queue.heard(kStart + 215ms), 20 * kMs) << "silence is still heard";
  device.fetch();
  EXPECT_EQ(queue.heard(kStart + 225ms), 25 * kMs);
}

TEST(SoundQueue, ClockNeverGoesBack) {
  SoundQueue queue(kRate, 1);
  Device device(queue);
  queue.add(ramp(10 * kBlock));
  device.fetch(3);
  const auto before = queue.heard(kStart + 59ms);
  device.fetch();  // late in being noticed
  EXPECT_GE(queue.heard(kStart + 41ms), before);
}

TEST(SoundQueue, RestartForgetsWhatIsNotFetched) {
  SoundQueue queue(kRate, 1);
  Device device(queue);
  queue.add(ramp(10 * kBlock));
  device.fetch(4);
  queue.restart(90000);
  EXPECT_EQ(queue.waiting(), 0);
  EXPECT_EQ(queue.heard(kStart + 70ms), 90000) << "what was fetched before is not of that time";
  queue.add(ramp(kBlock, 5000));
  EXPECT_EQ(device.fetch(), ramp(kBlock, 5000));
  EXPECT_EQ(queue.heard(kStart + 95ms), 90000);
  device.fetch();
  EXPECT_EQ(queue.heard(kStart + 110ms), 90000 + 10 * kMs);
}

TEST(SoundQueue, ClockIsThatOfTheStreamAtAnyRateAndNumberOfChannels) {
  SoundQueue queue(8000, 2);
  std::vector<std::int16_t> block(2 * 160);  // 20 ms
  queue.add(ramp(2 * 1600));
  for (int k = 0; k < 4; ++k) queue.fetch(block, kStart + k * 20ms);
  EXPECT_EQ(queue.heard(kStart + 70ms), 50 * kMs);
  EXPECT_EQ(queue.waiting(), 1600 - 4 * 160);
}

TEST(SoundQueue, GainCountsFromTheNextBlock) {
  SoundQueue queue(kRate, 1);
  Device device(queue);
  queue.add(ramp(2 * kBlock));
  device.fetch();
  queue.set_gain(0.5);
  EXPECT_EQ(device.fetch()[1], (kBlock + 2) / 2);
}

}  // namespace
}  // namespace fbs::cli
