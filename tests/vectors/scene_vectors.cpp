#include "tests/vectors/scene_vectors.h"

#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/setup_payload.h"

namespace fbs {
namespace {

// Pictures of the scenes: the encoder finds the cut to the talker.
constexpr std::uint64_t kFirst = 6, kSecond = 10, kAll = kFirst + 2 * kSecond;

constexpr StreamPosition position(std::uint64_t pictures) {
  return {pictures, pictures * 3000};  // 30 pictures a second
}

/// Six grey pictures, then somebody.
Bytes late() {
  std::vector<Picture> pictures(6, Picture(96, 80));
  for (const Picture& p : pictures_of(talker_settings(96, 80, 10))) pictures.push_back(p);
  return encoded(pictures, one_pattern());
}

using Scene = std::vector<Piece>;

/// The scenes of a stream, without the end packet.
std::vector<Scene> scenes_of(const Bytes& stream) {
  std::vector<Scene> out;
  for (const Piece& piece : pieces_of(stream)) {
    if (piece.type == PacketType::kSetup) out.emplace_back();
    if (piece.type != PacketType::kEnd) out.back().push_back(piece);
  }
  return out;
}

Scene moved(Scene scene, const StreamPosition& before) {
  Setup setup = must(decode_setup(scene.front().payload));
  setup.before = before;
  scene.front().payload = must(encode_setup(setup));
  return scene;
}

std::vector<Piece> pieces_of_scenes(const std::vector<Scene>& scenes, std::uint64_t pictures) {
  std::vector<Piece> pieces;
  for (const Scene& scene : scenes) pieces.insert(pieces.end(), scene.begin(), scene.end());
  pieces.push_back({PacketType::kEnd, encode_end({pictures})});
  return pieces;
}

Bytes joined_scenes(const std::vector<Scene>& scenes, std::uint64_t pictures) {
  return joined(pieces_of_scenes(scenes, pictures));
}

}  // namespace

Bytes add_scenes(Folder& folder) {
  const Bytes stream = late();
  const auto scenes = scenes_of(stream);
  if (scenes.size() != 2 || must(decode_setup(scenes[1].front().payload)).before != position(kFirst))
    give_up("the talker does not begin the second scene");
  folder.add("late.fbs", stream, kFirst + kSecond);
  folder.add("joined.fbs", joined_scenes({scenes[1]}, kFirst + kSecond), kSecond);
  return stream;
}

void add_broken_scenes(Folder& folder) {
  constexpr std::uint64_t kThird = kFirst + kSecond;
  const auto scenes = scenes_of(late());
  const auto three = [&](std::uint64_t before) {
    return std::vector{scenes[0], scenes[1], moved(scenes[1], position(before))};
  };
  folder.add("lost_scene.fbs", joined_scenes({scenes[0], moved(scenes[1], position(kThird))}, kAll), kAll,
             "kInvalidStream");
  Bytes flipped = joined_scenes(three(kThird), kAll);
  flipped[offset_of(scenes[0], scenes[0].size()) + 5] ^= 0x30;
  folder.add("flipped_setup.fbs", flipped, kAll, "kInvalidStream");
  folder.add("removed_second_setup.fbs",
             joined_without(pieces_of_scenes(three(kThird), kAll), scenes[0].size()), kAll, "kInvalidStream");
  folder.add("backwards.fbs", joined_scenes(three(5), kAll), kAll, "kInvalidStream");
  const std::uint64_t many = kThird + kMaxHeldPictures + 1;
  folder.add("too_many_before.fbs", joined_scenes(three(many), many + kSecond), kAll, "kTooLarge");
}

}  // namespace fbs
