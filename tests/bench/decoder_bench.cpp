#include <benchmark/benchmark.h>

#include <cmath>

#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/setup_payload.h"
#include "decoder/head/head_mesh.h"
#include "decoder/pattern/pattern_decoder.h"
#include "decoder/raster/rasteriser.h"
#include "tests/unit/toy_scene.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {
namespace {

constexpr int kWidth = 352, kHeight = 288;

void OneTriangle(benchmark::State& state) {
  const Plane pattern = noise_plane(kWidth, kHeight, 1);
  Plane target(kWidth, kHeight);
  const ConstPlaneView from = pattern;
  const PlaneView to = target;
  // Half the picture; the texture slightly rotated.
  const ScreenTriangle t = {{{{0, 0}}, {{kWidth * 64, 0}}, {{kWidth * 64, kHeight * 64}}}};
  const TriangleLook look{
      {glm::ivec2(256, 256), {kWidth * 64 - 256, 896}, {kWidth * 64 - 896, kHeight * 64 - 256}}};
  Rasteriser raster;
  for (auto _ : state) {
    raster.start(PlaneScale::kLuma, {0, 0, kWidth, kHeight}, {{&from, 1}, LightUse::kNone, {}, {&to, 1}});
    raster.add(t, look);
    raster.draw();
    benchmark::DoNotOptimize(target.samples.data());
  }
  state.SetItemsProcessed(state.iterations() * (kWidth * kHeight / 2));
}
BENCHMARK(OneTriangle);

/// A face that fills much of the picture: 96 pixels between the eyes at CIF.
Scene close_up(int width, int height, int follow) {
  Scene scene;
  scene.setup = toy_setup(width, height);
  State seen;
  seen.pose[kShiftX] = width * 32;
  seen.pose[kShiftY] = height * 26;
  seen.pose[kLogScale] = static_cast<std::int32_t>(4096 * std::log2(height / 3.0));
  scene.geometry.emplace(scene.setup, toy_geometry(), even_surround(22, 18, follow), seen);
  scene.patterns.push_back(make_pattern(noise_picture(width, height, 2), seen, scene.geometry));
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
  const ScreenMesh mesh = scene.geometry->screen_mesh(moved(scene, 0));
  const TextureMesh& texture = scene.patterns[0].texture;
  Plane target(kWidth, kHeight);
  const ConstPlaneView from = scene.patterns[0].picture.y;
  const PlaneView to = target;
  Rasteriser raster;
  for (auto _ : state) {
    raster.start(PlaneScale::kLuma, {0, 0, kWidth, kHeight}, {{&from, 1}, LightUse::kNone, {}, {&to, 1}});
    for (const auto& triangle : generic_head_mesh().triangles) {
      ScreenTriangle t;
      TriangleLook look;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto v = triangle[i];
        t[i] = {glm::ivec2(mesh.head[v]), mesh.head[v].z};
        look.corners[i] = texture.head[v];
      }
      raster.add(t, look);
    }
    raster.draw();
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
    if (!renderer.render(scene, moved(scene, ++step), out)) state.SkipWithError("not drawn");
    benchmark::DoNotOptimize(out.y.samples.data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(Render)->Args({176, 144})->Args({352, 288})->Args({1280, 720})->Unit(benchmark::kMicrosecond);

/// Blends of eight patterns, by the mode of all regions.
void RenderBlend(benchmark::State& state) {
  Scene scene = close_up(kWidth, kHeight, 2);
  for (int k = 1; k < 8; ++k) {
    State seen = moved(scene, 12 * k);
    seen.picture = 12 * k;
    scene.patterns.push_back(make_pattern(noise_picture(kWidth, kHeight, 3u + k), seen, scene.geometry));
  }
  Renderer renderer;
  Picture out;
  int step = 0;
  for (auto _ : state) {
    State picture = moved(scene, ++step % 84);
    picture.picture = step % 84;
    picture.blend.fill(static_cast<BlendMode>(state.range(0)));
    if (!renderer.render(scene, picture, out)) state.SkipWithError("not drawn");
    benchmark::DoNotOptimize(out.y.samples.data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(RenderBlend)->DenseRange(0, static_cast<int>(BlendMode::kNearest))->Unit(benchmark::kMicrosecond);

void PatternDecode(benchmark::State& state) {
  const auto stream = read_bytes(FBS_VECTORS "/talk.fbs");
  PacketReader reader;
  reader.feed(stream);
  Setup setup;
  std::vector<std::uint8_t> av1;
  for (auto read = reader.next(); read && read->status == ReadStatus::kPacket && av1.empty();
       read = reader.next()) {
    if (read->packet.type == PacketType::kSetup) setup = *decode_setup(read->packet.payload);
    if (read->packet.type == PacketType::kPattern)
      av1 = PatternPacketReader().decode(read->packet.payload, setup, 0)->front().av1;
  }
  for (auto _ : state) {
    auto decoder = PatternDecoder::create(setup.format.width, setup.format.height);
    benchmark::DoNotOptimize(decoder->decode(av1));
  }
}
BENCHMARK(PatternDecode)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace fbs
