// Bytes to the list of scenes: they are in order, do not overlap and lie within the stream.
#include "decoder/stream/scene_index.h"

#include "tests/fuzz/fuzz_target.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return {stream};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::uint64_t end = 0;
  fbs::StreamPosition last;
  const auto scenes = fbs::index_scenes({data, size});
  for (const fbs::SceneEntry& scene : scenes) {
    require(scene.offset >= end && scene.bytes > 0, "scenes overlap");
    end = scene.offset + scene.bytes;
    require(end <= size, "a scene of bytes that are not there");
    require(scene.before.pictures >= last.pictures && scene.before.time >= last.time,
            "a scene that goes back");
    last = scene.before;
    if (!scene.is_joinable) continue;
    const fbs::SceneEntry* const found = fbs::scene_at(scenes, scene.before.time);
    require(found != nullptr && found->before.time == scene.before.time,
            "another scene than that of the time");
  }
  return 0;
}
