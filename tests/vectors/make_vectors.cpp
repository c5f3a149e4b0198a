// make_vectors FOLDER: writes all test vectors and their table. Everything in them is generated: the talker,
// and states from a fixed seed. See make.sh and README.md.
#include <random>

#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "encoder/patterns/pattern_encoder.h"
#include "tests/vectors/blend_vectors.h"
#include "tests/vectors/limits_vectors.h"
#include "tests/vectors/loss_vectors.h"
#include "tests/vectors/return_vectors.h"
#include "tests/vectors/scene_vectors.h"
#include "tests/vectors/sound_vectors.h"
#include "tests/vectors/vector_tools.h"
#include "tests/vectors/wire_frame_vectors.h"

namespace fbs {
namespace {

void add_good(Folder& folder, const Bytes& talk) {
  folder.add("talk.fbs", talk, 20);
  auto turning = talker_settings(128, 96, 24);
  turning.motion = talker::Motion::kTurns;
  turning.yaw_deg = 25;
  turning.frame_rate = {6, 1};  // four seconds in 24 pictures
  folder.add("turns.fbs", encoded(pictures_of(turning), one_pattern()), 24);
  folder.add("odd.fbs", encoded(pictures_of(talker_settings(67, 65, 8)), one_pattern()), 8);
  folder.add("one.fbs", encoded(pictures_of(talker_settings(96, 80, 1)), one_pattern()), 1);

  EncoderSettings anything = one_pattern();
  anything.allow_no_face = true;
  folder.add("nobody.fbs", encoded(std::vector<Picture>(4, Picture(64, 64)), anything), 4);
  std::vector<std::uint32_t> durations;
  for (std::uint32_t i = 0; i < 12; ++i) durations.push_back(i % 3 == 2 ? 6000 : 3000);
  folder.add("durations.fbs", encoded(pictures_of(talker_settings(96, 80, 12)), one_pattern(4), durations),
             12);

  auto pieces = pieces_of(talk);
  pieces[place_of(pieces, PacketType::kSetup)].payload.insert(
      pieces[0].payload.end(), {1, 0, 0, 0, 9, 9});  // 1: patterns, 0: contrasts, keeps
  pieces[place_of(pieces, PacketType::kEnd)].payload.push_back(7);
  pieces.insert(pieces.begin() + 2, {static_cast<PacketType>(99), Bytes(40, 0x5A)});
  pieces.insert(pieces.begin(), {static_cast<PacketType>(98), {}});
  folder.add("later_writer.fbs", joined(pieces), 20);
  folder.add("removed_unknown.fbs", joined_without(pieces, 3), 20);
}

/// Packets that a network has lost or delivered twice.
void add_removed(Folder& folder, const Bytes& talk) {
  const auto pieces = pieces_of(talk);
  const std::size_t motion = place_of(pieces, PacketType::kMotion, 1);
  folder.add("removed_setup.fbs", joined_without(pieces, 0), 0, "kInvalidStream");
  folder.add("removed_pattern.fbs", joined_without(pieces, place_of(pieces, PacketType::kPattern)), 0,
             "kInvalidStream");
  folder.add("removed_motion.fbs", joined_without(pieces, motion), 20, "kInvalidStream");
  folder.add("removed_end.fbs", joined_without(pieces, pieces.size() - 1), 20);
  folder.add("doubled_motion.fbs", joined_with_two(pieces, motion), 20);
}

/// One wrong bit in each packet, in its payload or its check.
void add_repaired(Folder& folder, const Bytes& talk) {
  const auto pieces = pieces_of(talk);
  Bytes wrong = talk;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    wrong[offset_of(pieces, k + 1) - 1 - k % 3] ^= static_cast<std::uint8_t>(1U << k % 8);
  folder.add("repaired.fbs", wrong, 20);
}

void add_broken(Folder& folder, const Bytes& talk) {
  const auto pieces = pieces_of(talk);
  const std::size_t third_motion = offset_of(pieces, place_of(pieces, PacketType::kMotion, 2));
  folder.add("truncated.fbs", {talk.begin(), talk.begin() + third_motion + 5}, 6, "kTruncated");
  Bytes flipped = talk;
  flipped[offset_of(pieces, place_of(pieces, PacketType::kMotion, 1)) + 4] ^= 0x30;
  folder.add("flipped_bits.fbs", flipped, 20, "kInvalidStream");
  const std::string y4m = "YUV4MPEG2 W64 H64 F30:1 Ip A1:1 C420jpeg\nFRAME\n";
  folder.add("not_fbs.fbs", {y4m.begin(), y4m.end()}, 0, "kNotFbs");

  const auto with = [&](PacketType type, const Bytes& payload) {
    auto changed = pieces;
    changed[place_of(changed, type)].payload = payload;
    return joined(changed);
  };
  Bytes newer = pieces[0].payload;
  newer[0] = kFormatVersion + 1;
  folder.add("newer.fbs", with(PacketType::kSetup, newer), 0, "kUnsupported");
  Bytes oversized = pieces[0].payload;
  const auto size = oversized.begin() + 4;  // behind version, head, pictures and time before
  const Bytes wide = {0x80, 0x80, 0x01};    // 16384
  oversized.erase(size, size + 3);          // 128 in two bytes, 96 in one
  for (int side = 0; side < 2; ++side) oversized.insert(oversized.begin() + 4, wide.begin(), wide.end());
  folder.add("oversized.fbs", with(PacketType::kSetup, oversized), 0, "kTooLarge");
  Bytes long_packet = joined({pieces[0]});
  long_packet.insert(long_packet.end(),
                     {static_cast<std::uint8_t>(PacketType::kPattern), 0xFF, 0xFF, 0xFF, 0xFF, 0x0F});
  folder.add("long_packet.fbs", long_packet, 0, "kTooLarge");

  auto no_setup = pieces;
  no_setup.erase(no_setup.begin());
  folder.add("no_setup.fbs", joined(no_setup), 0, "kInvalidStream");
  auto no_pattern = pieces;
  no_pattern.erase(no_pattern.begin() + place_of(pieces, PacketType::kPattern));
  folder.add("no_pattern.fbs", joined(no_pattern), 0, "kInvalidStream");
  auto lost_key = pieces;
  lost_key.erase(lost_key.begin() + place_of(pieces, PacketType::kMotion));
  folder.add("lost_key.fbs", joined(lost_key), 0, "kInvalidStream");
  const Setup setup = must(decode_setup(pieces[0].payload));
  const PatternSyntax pattern = patterns_of(pieces).front().patterns.front();
  const auto encoded_alone = [&](const PatternSyntax& p) { return must(encode_first_pattern(p, setup)); };
  PatternSyntax bad_av1 = pattern, wrong_size = pattern;
  bad_av1.av1.resize(pattern.av1.size() / 2);
  folder.add("bad_av1.fbs", with(PacketType::kPattern, encoded_alone(bad_av1)), 0, "kInvalidStream");
  VideoFormat smaller = setup.format;
  smaller.width -= 2;
  wrong_size.av1 =
      must(must(PatternEncoder::create(smaller, 60)).encode(Picture(smaller.width, smaller.height)));
  folder.add("wrong_size.fbs", with(PacketType::kPattern, encoded_alone(wrong_size)), 0, "kInvalidStream");
}

}  // namespace
}  // namespace fbs

int main(int argc, char** argv) {
  if (argc != 2) fbs::give_up("which folder?");
  fbs::Folder folder(argv[1]);
  const fbs::Bytes talk =
      fbs::encoded(fbs::pictures_of(fbs::talker_settings(128, 96, 20)), fbs::one_pattern(5));
  fbs::add_good(folder, talk);
  const fbs::Bytes late = fbs::add_scenes(folder);
  fbs::add_sound(folder, argv[1], talk, late);
  fbs::add_limits(folder);
  fbs::add_blends(folder);
  fbs::add_wire_frames(folder, talk);
  fbs::add_repaired(folder, talk);
  fbs::add_broken(folder, talk);
  fbs::add_removed(folder, talk);
  fbs::add_broken_scenes(folder);
  fbs::add_losses(folder);
  fbs::add_returns(folder);
  fbs::add_broken_blends(folder, talk);
  fbs::add_broken_wire_frames(folder, talk);
  return 0;
}
