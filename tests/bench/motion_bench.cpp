#include <benchmark/benchmark.h>

#include <random>

#include "bitstream/motion_payload.h"

namespace fbs {
namespace {

constexpr std::size_t kGroup = 30;

Setup setup_of() {
  Setup setup;
  setup.format.width = 352;
  setup.format.height = 288;
  setup.steps = {40, 16, 8, 64};
  setup.features = (1 << kFeatureCount) - 1;
  return setup;
}

/// Groups as an encoder writes them: one number in eight moves by a step or two.
std::vector<MotionGroup> groups(const Setup& setup, int count) {
  std::mt19937 random(1);
  const StateLimits limits(setup);
  FlatState flat{};
  flat[kLogScale] = 600;
  std::vector<MotionGroup> out;
  for (int g = 0; g < count; ++g) {
    MotionGroup group{g == 0, {}, {}};
    for (std::size_t t = 0; t < kGroup; ++t) {
      for (std::size_t i = 0; i < kParameterCount; ++i)
        if (random() % 8 == 0)
          flat[i] = std::clamp(flat[i] + static_cast<int>(random() % 5) - 2, limits.least[i], limits.most[i]);
      group.states.push_back(unflatten(flat));
    }
    out.push_back(group);
  }
  return out;
}

void MotionEncode(benchmark::State& state) {
  const Setup setup = setup_of();
  const auto all = groups(setup, 4);
  MotionCoder before(setup);
  (void)before.encode(all[0]).has_value();
  for (auto _ : state) {
    MotionCoder coder = before;
    benchmark::DoNotOptimize(coder.encode(all[1]));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kGroup));
}
BENCHMARK(MotionEncode)->Unit(benchmark::kMicrosecond);

void MotionDecode(benchmark::State& state) {
  const Setup setup = setup_of();
  const auto all = groups(setup, 2);
  MotionCoder writer(setup), before(setup);
  const auto first = *writer.encode(all[0]), second = *writer.encode(all[1]);
  (void)before.decode(first).has_value();
  for (auto _ : state) {
    MotionCoder coder = before;
    benchmark::DoNotOptimize(coder.decode(second));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kGroup));
}
BENCHMARK(MotionDecode)->Unit(benchmark::kMicrosecond);

void MotionCount(benchmark::State& state) {
  const Setup setup = setup_of();
  const auto all = groups(setup, 2);
  MotionCoder coder(setup);
  (void)coder.encode(all[0]).has_value();
  const MotionCounter counter(coder);
  for (auto _ : state) benchmark::DoNotOptimize(counter.cost(all[1].states[0]));
}
BENCHMARK(MotionCount)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace fbs
