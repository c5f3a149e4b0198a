#include <benchmark/benchmark.h>

#include <random>

#include "bitstream/motion/motion_bit_counter.h"
#include "bitstream/motion/motion_decoder.h"
#include "bitstream/motion/motion_encoder.h"
#include "bitstream/track.h"
#include "tests/unit/bitstream/random_tracks.h"

namespace fbs {
namespace {

constexpr std::int32_t kGroup = 30;

Setup setup_of() {
  Setup setup;
  setup.format.width = 352;
  setup.format.height = 288;
  setup.steps = {40, 16, 8, 16, 64};
  return setup;
}

CodedState seen() {
  CodedState state{};
  state[kLogScale] = 600;
  return state;
}

/// Groups like the encoder's: about one knot in four pictures, small changes.
std::vector<MotionGroup> groups(const Setup& setup, int count) {
  std::mt19937 random(1);
  const CodedLimits limits(setup.steps, setup.parts);
  std::vector<MotionGroup> out;
  CodedState anchor = seen();
  for (int g = 0; g < count; ++g) {
    MotionGroup group =
        random_group(random, limits, anchor, kGroup, {.knot_one_in = 4, .moves_one_in = 2, .reach = 2});
    group.key = g == 0;
    anchor = last_of(group);
    out.push_back(group);
  }
  return out;
}

void MotionEncode(benchmark::State& state) {
  const Setup setup = setup_of();
  const auto all = groups(setup, 4);
  MotionEncoder before(setup, seen());
  (void)before.encode(all[0]).has_value();
  for (auto _ : state) {
    MotionEncoder coder = before;
    benchmark::DoNotOptimize(coder.encode(all[1]));
  }
  state.SetItemsProcessed(state.iterations() * kGroup);
}
BENCHMARK(MotionEncode)->Unit(benchmark::kMicrosecond);

void MotionDecode(benchmark::State& state) {
  const Setup setup = setup_of();
  const auto all = groups(setup, 2);
  MotionEncoder writer(setup, seen());
  MotionDecoder before(setup, seen());
  const auto first = *writer.encode(all[0]), second = *writer.encode(all[1]);
  (void)before.decode(first).has_value();
  for (auto _ : state) {
    MotionDecoder coder = before;
    benchmark::DoNotOptimize(coder.decode(second));
  }
  state.SetItemsProcessed(state.iterations() * kGroup);
}
BENCHMARK(MotionDecode)->Unit(benchmark::kMicrosecond);

void MotionCount(benchmark::State& state) {
  const Setup setup = setup_of();
  const auto all = groups(setup, 2);
  MotionBitCounter before(setup, seen());
  (void)before.count(all[0]);
  for (auto _ : state) {
    MotionBitCounter counter = before;
    benchmark::DoNotOptimize(counter.count(all[1]));
  }
  state.SetItemsProcessed(state.iterations() * kGroup);
}
BENCHMARK(MotionCount)->Unit(benchmark::kMicrosecond);

void MotionStates(benchmark::State& state) {
  const Setup setup = setup_of();
  const auto all = groups(setup, 1);
  for (auto _ : state) benchmark::DoNotOptimize(states_of(all[0], setup.steps));
  state.SetItemsProcessed(state.iterations() * kGroup);
}
BENCHMARK(MotionStates)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace fbs
