// The steps from a state to samples, each alone, and whole streams.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "decoder/blend/head_weights.h"
#include "decoder/field/blend_kernels.h"
#include "decoder/field/node_weights.h"
#include "decoder/field/surround_field.h"
#include "decoder/field/warp_kernels.h"
#include "decoder/stream/stream_decoder.h"
#include "tests/unit/toy_scene.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {
namespace {

constexpr int kWidth = 352, kHeight = 288;

SceneGeometry geometry() {
  return {toy_setup(kWidth, kHeight), toy_geometry(), even_surround(22, 18, 2), toy_state()};
}

State turned(int step) {
  State s = toy_state();
  s.pose[kYaw] += 10 * (step % 100);
  return s;
}

void Animate(benchmark::State& state) {
  const SceneGeometry g = geometry();
  int step = 0;
  for (auto _ : state) benchmark::DoNotOptimize(g.screen_mesh(turned(++step)));
}
BENCHMARK(Animate)->Unit(benchmark::kMicrosecond);

/// Cover, weights and displacements of the nodes of a picture from some sources.
void Nodes(benchmark::State& state) {
  const SceneGeometry g = geometry();
  const auto sources = static_cast<std::size_t>(state.range(0));
  std::vector<TextureMesh> textures;
  for (std::size_t s = 0; s < sources; ++s)
    textures.push_back(g.texture_mesh(turned(static_cast<int>(20 * s))));
  std::vector<const std::vector<glm::ivec2>*> seen;
  for (const TextureMesh& t : textures) seen.push_back(&t.surround);
  PointWeights corners{sources, {}};
  for (std::size_t p = 0; p < g.surround().point_count(); ++p)
    for (std::size_t s = 0; s < sources; ++s)
      corners.weights.push_back(kMeshWeightOne / static_cast<int>(sources));
  const std::vector<std::int32_t> outside(sources, kNodeWeightOne / static_cast<int>(sources));
  NodeCover cover;
  NodeWeights weights;
  SurroundField field;
  int step = 0;
  for (auto _ : state) {
    const ScreenMesh mesh = g.screen_mesh(turned(++step));
    cover.find(NodeGrid(kWidth, kHeight), g.surround_triangles(), mesh.surround);
    weights.set(cover, corners, outside);
    field.set(cover, seen, mesh.surround, {kWidth, kHeight});
    benchmark::DoNotOptimize(field.at(0, 0));
  }
}
BENCHMARK(Nodes)->Arg(2)->Arg(8)->Arg(16)->Unit(benchmark::kMicrosecond);

/// A block of 16 x 16 from some sources: Y, U and V.
void BlendBlock(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const Picture picture = noise_picture(64, 64, 1);
  const std::vector<std::uint16_t> weights(9 * count, static_cast<std::uint16_t>(kNodeWeightOne / count));
  std::vector<BlendedSource> sources;
  for (std::size_t s = 0; s < count; ++s)
    sources.push_back({{SampleBlock{picture.y.row(0) + s, 64}, SampleBlock{picture.u.row(0) + s, 32},
                        SampleBlock{picture.v.row(0) + s, 32}},
                       weights.data() + s});
  const auto row = static_cast<std::ptrdiff_t>(count);
  std::vector<std::uint8_t> out(3 * 256);
  for (auto _ : state) {
    blend_luma_block(sources, {row, 3 * row}, out.data(), 16);
    blend_chroma_block(sources, {row, 3 * row}, {out.data() + 256, out.data() + 512}, 16);
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(state.iterations() * 384);
}
BENCHMARK(BlendBlock)->Arg(2)->Arg(4)->Arg(8);

/// The four patches of a block of one source, with this difference of displacement at the right nodes, 1/64
/// sample.
void WarpBlock(benchmark::State& state) {
  const Picture picture = noise_picture(128, 128, 2);
  const int bend = static_cast<int>(state.range(0));
  const PatchNodes nodes{
      glm::ivec2(33, 17), {33 + bend, 17 + bend / 2}, {33, 17}, {33 + bend, 17 + bend / 2}};
  std::array<WarpedBlock, 3> out;
  for (auto _ : state) {
    if (bend == 0) {
      warp_even_luma(picture.y.row(40) + 40, 128, nodes[0], kBlockSize, out[0].samples.data());
      warp_even_chroma({picture.u.row(20) + 20, picture.v.row(20) + 20}, 64, nodes[0] / 2, kBlockSize / 2,
                       {out[1].samples.data(), out[2].samples.data()});
    } else {
      for (int k = 0; k < 4; ++k) {
        warp_bent_luma(picture.y.row(40) + 40, 128, nodes, out[0].samples.data());
        warp_bent_chroma({picture.u.row(20) + 20, picture.v.row(20) + 20}, 64, nodes,
                         {out[1].samples.data(), out[2].samples.data()});
      }
    }
    benchmark::DoNotOptimize(out[0].samples.data());
  }
  state.SetItemsProcessed(state.iterations() * 384);
}
BENCHMARK(WarpBlock)->Arg(0)->Arg(60)->Arg(300);

/// A whole stream: the one named by FBS_STREAM, or a vector. The counter is the time for each luma sample.
void Decode(benchmark::State& state) {
  const char* const named = std::getenv("FBS_STREAM");  // NOLINT(concurrency-mt-unsafe)
  const auto bytes = read_bytes(named != nullptr ? named : FBS_VECTORS "/talk.fbs");
  double samples = 0;
  for (auto _ : state) {
    StreamDecoder decoder;
    decoder.use_threads(static_cast<int>(state.range(0)));
    decoder.feed(bytes);
    decoder.close();
    Picture picture;
    for (auto next = decoder.next(); next && *next == DecodeStatus::kPicture; next = decoder.next()) {
      if (!decoder.render(picture)) state.SkipWithError("not drawn");
      samples += static_cast<double>(picture.width()) * picture.height();
    }
  }
  state.counters["per_sample"] =
      benchmark::Counter(samples, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(Decode)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace fbs
