// The stages of the analysis, picture by picture of a CIF talker, and all of them together: Encoder::push.
#include <benchmark/benchmark.h>

#include <string>

#include "encoder/encoder.h"
#include "encoder/plan/track_planner.h"
#include "encoder/track/snake/snake_descent.h"
#include "tests/bench/analysis_clip.h"

namespace fbs {
namespace {

/// Loops over the clip, one picture per iteration, and reports pictures per second.
template <class Stage>
void each_picture(benchmark::State& state, Stage stage) {
  const auto& round = analysis_clip().round();
  std::size_t i = 0;
  for (auto _ : state) {
    i = (i + 1) % round.size();
    stage(round[i]);
  }
  state.SetItemsProcessed(state.iterations());
}

void per_picture(benchmark::State& state, const char* name, int sum) {
  state.counters[name] = static_cast<double>(sum) / static_cast<double>(state.iterations());
}

void WorkFrameCut(benchmark::State& state) {
  const AnalysisClip& clip = analysis_clip();
  each_picture(state, [&](const AnalysedPicture& p) {
    benchmark::DoNotOptimize(WorkFrame::cut(p.picture, p.tracked.pose.shift, clip.eye_distance_px(), true));
  });
}
BENCHMARK(WorkFrameCut)->Unit(benchmark::kMicrosecond);

void HeadTrack(benchmark::State& state) {
  const AnalysisClip& clip = analysis_clip();
  HeadTracker tracker(clip.geometry(), clip.pose(), clip.first());
  each_picture(state, [&](const AnalysedPicture& p) {
    benchmark::DoNotOptimize(tracker.track(p.frame, clip.neutral()));
  });
}
BENCHMARK(HeadTrack)->Unit(benchmark::kMicrosecond);

/// All snakes: patches, feature maps, starts and descents.
void FeatureTrack(benchmark::State& state) {
  const AnalysisClip& clip = analysis_clip();
  FeatureTracker tracker(clip.geometry(), clip.pose(), clip.first());
  int iterations = 0;
  each_picture(state, [&](const AnalysedPicture& p) {
    tracker.track(p.frame, p.tracked.pose, p.flow);
    for (std::size_t s = 0; s < tracker.count(); ++s) iterations += tracker.iterations(s);
  });
  per_picture(state, "iterations", iterations);
}
BENCHMARK(FeatureTrack)->Unit(benchmark::kMicrosecond);

/// One feature by itself: patch and feature map with `look`, else the descent alone from its last position.
void one_snake(benchmark::State& state, FeatureId id, bool look) {
  const AnalysisClip& clip = analysis_clip();
  FeatureSnake snake = FeatureSnake::make(id, clip.geometry());
  snake.learn(snake.patch(clip.first(), clip.pose()));
  (void)snake.observe(snake.patch(clip.first(), clip.pose()));
  std::vector<SnakeImage> images;
  for (const AnalysedPicture& p : clip.round())
    images.push_back(snake.observe(snake.patch(p.frame, p.tracked.pose)));
  int iterations = 0;
  std::size_t i = 0;
  each_picture(state, [&](const AnalysedPicture& p) {
    i = (i + 1) % images.size();
    if (look) benchmark::DoNotOptimize(images[i] = snake.observe(snake.patch(p.frame, p.tracked.pose)));
    const SnakeOutcome out = descend(
        BSnake(snake.curve, images[i], snake.weights, snake.rest, snake.now, snake.facing), snake.now);
    snake.now = out.control;
    snake.limit(snake.now);
    iterations += out.iterations;
  });
  per_picture(state, "iterations", iterations);
}

void FitRefine(benchmark::State& state) {
  const AnalysisClip& clip = analysis_clip();
  PictureFit fit(clip.setup(), clip.geometry(), {clip.first(), clip.seen()});
  each_picture(state, [&](const AnalysedPicture& p) {
    fit.set_picture(p.frame);
    benchmark::DoNotOptimize(fit.refine(p.tracked_fit));
  });
}
BENCHMARK(FitRefine)->Unit(benchmark::kMicrosecond);

void FitCostAt(benchmark::State& state) {
  const AnalysisClip& clip = analysis_clip();
  PictureFit fit(clip.setup(), clip.geometry(), {clip.first(), clip.seen()});
  each_picture(state, [&](const AnalysedPicture& p) {
    fit.set_picture(p.frame);
    benchmark::DoNotOptimize(fit.cost_at(p.tracked_fit));
  });
}
BENCHMARK(FitCostAt)->Unit(benchmark::kMicrosecond);

void TrackPlan(benchmark::State& state) {
  constexpr int kGroup = 30;
  const AnalysisClip& clip = analysis_clip();
  const TrackPlanner planner(clip.setup().steps, clip.setup().parts);
  std::vector<PictureCost> fits;
  for (std::size_t i = 1; i <= kGroup; ++i) fits.push_back(clip.round()[i].cost);
  for (auto _ : state)
    benchmark::DoNotOptimize(planner.plan(clip.seen_coded(), fits, TrackRate(), clip.lambda()));
  state.SetItemsProcessed(state.iterations() * kGroup);
}
BENCHMARK(TrackPlan)->Unit(benchmark::kMillisecond);

/// Total time per picture once the scene has started: analysis and its share of motion coding. The two
/// seconds from which the surround is learned come before the clock starts.
void EncoderPush(benchmark::State& state, bool expression) {
  AnalysisClip& clip = analysis_clip();
  EncoderSettings settings;
  settings.expression = expression;
  auto encoder = Encoder::create(clip.format(), settings);
  if (!encoder) return state.SkipWithError(encoder.error().text.c_str());
  const auto& round = clip.round();
  constexpr std::size_t kLookahead = 2 * 30;
  for (std::size_t i = 0; i <= kLookahead; ++i) {
    if (!encoder->push(round[i % round.size()].picture)) return state.SkipWithError("a picture is refused");
    (void)encoder->take();
  }
  std::size_t i = kLookahead;
  double least = 1;
  for (auto _ : state) {
    i = (i + 1) % round.size();
    (void)encoder->push(round[i].picture);
    benchmark::DoNotOptimize(encoder->take());
    least = std::min(least, encoder->analysis().confidence);
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["least_confidence"] = least;  // low: the face was lost, and the time includes a search
}
BENCHMARK_CAPTURE(EncoderPush, all, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(EncoderPush, without_expression, false)->Unit(benchmark::kMicrosecond);

/// Registers a pair of benchmarks for each kind of snake; right and left take the same time.
const bool kRegistered = [] {
  for (const FeatureId id :
       {FeatureId::kMouthOuter, FeatureId::kMouthInner, FeatureId::kBrowRight, FeatureId::kUpperLidRight}) {
    const std::string name(feature(id).name);
    benchmark::RegisterBenchmark(("Snake/" + name).c_str(), one_snake, id, true)
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("SnakeDescent/" + name).c_str(), one_snake, id, false)
        ->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

}  // namespace
}  // namespace fbs
