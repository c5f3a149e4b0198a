#include <benchmark/benchmark.h>

#include <cmath>

#include "bitstream/packet.h"
#include "bitstream/payload/pattern_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "decoder/pattern_decoder.h"
#include "tests/unit/toy_scene.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {
namespace {

constexpr int kWidth = 352, kHeight = 288;

enum class Reading { kInside, kAtBorder, kWithDepth };

void rasterise(benchmark::State& state, Reading reading) {
  const Plane pattern = noise_plane(kWidth, kHeight, 1);
  Plane target(kWidth, kHeight);
  const PlanePair pair{&pattern, &target};
  const SampleArea area{0, 0, kWidth, kHeight};
  // Half the picture; the texture slightly rotated.
  const int in = reading == Reading::kAtBorder ? 0 : 256;
  RasterTriangle t;
  t[0] = {{0, 0}, {in, in}, 0};
  t[1] = {{kWidth * 64, 0}, {kWidth * 64 - in, 640 + in}, 0};
  t[2] = {{kWidth * 64, kHeight * 64}, {kWidth * 64 - 640 - in, kHeight * 64 - in}, 0};
  DepthPlane depth;
  depth.reset(kWidth, kHeight, area);
  for (auto _ : state) {
    for (RasterVertex& v : t) --v.depth;  // always closer than before
    draw_triangle(t, PlaneScale::kLuma, {&pair, 1}, area, reading == Reading::kWithDepth ? &depth : nullptr);
    benchmark::DoNotOptimize(target.samples.data());
  }
  state.SetItemsProcessed(state.iterations() * (kWidth * kHeight / 2));
}
BENCHMARK_CAPTURE(rasterise, inside, Reading::kInside)->Name("Rasteriser/inside");
BENCHMARK_CAPTURE(rasterise, at_border, Reading::kAtBorder)->Name("Rasteriser/at_border");
BENCHMARK_CAPTURE(rasterise, with_depth, Reading::kWithDepth)->Name("Rasteriser/with_depth");

/// A face that fills much of the picture: 96 pixels between the eyes at CIF.
Scene close_up(int width, int height, int follow) {
  Scene scene;
  scene.setup = toy_setup(width, height);
  State seen;
  seen.pose[kShiftX] = width * 32;
  seen.pose[kShiftY] = height * 26;
  seen.pose[kLogScale] = static_cast<std::int32_t>(4096 * std::log2(height / 3.0));
  scene.geometry.emplace(scene.setup, toy_geometry(), even_surround(22, 18, follow), seen);
  scene.patterns.push_back({noise_picture(width, height, 2), scene.geometry->project(seen)});
  return scene;
}

State moved(const Scene& scene, int step) {
  State s;
  s.pose[kShiftX] = scene.setup.format.width * 32 + step % 64;
  s.pose[kShiftY] = scene.setup.format.height * 26 + step % 32;
  s.pose[kLogScale] = static_cast<std::int32_t>(4096 * std::log2(scene.setup.format.height / 3.0));
  s.pose[kYaw] = 1500 + step % 100;
  s.pose[kRoll] = 500;
  return s;
}

void HeadTriangles(benchmark::State& state) {
  const Scene scene = close_up(kWidth, kHeight, 0);
  const ScreenMesh now = scene.geometry->project(moved(scene, 0));
  const ScreenMesh& seen = scene.patterns[0].seen;
  Plane target(kWidth, kHeight);
  const PlanePair pair{&scene.patterns[0].picture.y, &target};
  const SampleArea area{0, 0, kWidth, kHeight};
  DepthPlane depth;
  for (auto _ : state) {
    depth.reset(kWidth, kHeight, area);
    for (const auto& triangle : head_mesh().triangles) {
      RasterTriangle t;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto v = triangle[i];
        t[i] = {glm::ivec2(now.head[v]), glm::ivec2(seen.head[v]), now.head[v].z};
      }
      draw_triangle(t, PlaneScale::kLuma, {&pair, 1}, area, &depth);
    }
    benchmark::DoNotOptimize(target.samples.data());
  }
}
BENCHMARK(HeadTriangles)->Unit(benchmark::kMicrosecond);

void Render(benchmark::State& state) {
  const Scene scene = close_up(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), 2);
  Renderer renderer;
  Picture out;
  int step = 0;
  for (auto _ : state) {
    renderer.render(scene, moved(scene, ++step), out);
    benchmark::DoNotOptimize(out.y.samples.data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(Render)->Args({176, 144})->Args({352, 288})->Args({1280, 720})->Unit(benchmark::kMicrosecond);

void PatternDecode(benchmark::State& state) {
  const auto stream = read_bytes(FBS_VECTORS "/talk.fbs");
  PacketReader reader;
  reader.feed(stream);
  Setup setup;
  std::vector<std::uint8_t> av1;
  for (auto read = reader.next(); read && read->status == ReadStatus::kPacket && av1.empty();
       read = reader.next()) {
    if (read->packet.type == PacketType::kSetup) setup = *decode_setup(read->packet.payload);
    if (read->packet.type == PacketType::kPattern) av1 = decode_pattern(read->packet.payload, setup)->av1;
  }
  for (auto _ : state) {
    auto decoder = PatternDecoder::create(setup.format.width, setup.format.height);
    benchmark::DoNotOptimize(decoder->decode(av1));
  }
}
BENCHMARK(PatternDecode)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace fbs
