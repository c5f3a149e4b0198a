// make_vectors FOLDER: writes all test vectors and their table. Everything in them is generated: the talker,
// and states from a fixed seed. See make.sh and README.md.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <random>

#include "bitstream/motion/motion_encoder.h"
#include "bitstream/packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/pattern_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "decoder/head/head_projection.h"
#include "encoder/encoder.h"
#include "encoder/patterns/pattern_encoder.h"
#include "samples/talker/talker_render.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {
namespace {

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] void give_up(const std::string& why) {
  std::cerr << "make_vectors: " << why << '\n';
  std::exit(1);
}

template <class T>
T must(Result<T> result) {
  if (!result) give_up(result.error().text);
  return std::move(*result);
}

EncoderSettings groups_of(int pictures) {
  EncoderSettings s;
  s.group_pictures = pictures;
  return s;
}

talker::Settings talker_settings(int width, int height, int frames) {
  talker::Settings s;
  s.width = width;
  s.height = height;
  s.frame_count = frames;
  return s;
}

std::vector<Picture> pictures_of(const talker::Settings& settings) {
  const talker::Talker talker(settings);
  std::vector<Picture> out;
  for (int i = 0; i < settings.frame_count; ++i) out.push_back(talker.picture(i));
  return out;
}

Bytes encoded(const std::vector<Picture>& pictures, const EncoderSettings& settings,
              const std::vector<std::uint32_t>& durations = {}) {
  VideoFormat format;
  format.width = pictures[0].width();
  format.height = pictures[0].height();
  format.frame_rate = {30, 1};
  auto encoder = must(Encoder::create(format, settings));
  for (std::size_t i = 0; i < pictures.size(); ++i)
    if (auto pushed = encoder.push(pictures[i], durations.empty() ? 0 : durations[i]); !pushed)
      give_up(pushed.error().text);
  if (auto finished = encoder.finish(); !finished) give_up(finished.error().text);
  return encoder.take();
}

/// One packet of a stream.
struct Piece {
  PacketType type;
  Bytes payload;
};

std::vector<Piece> pieces_of(const Bytes& stream) {
  PacketReader reader;
  reader.feed(stream);
  reader.close();
  std::vector<Piece> out;
  for (auto read = must(reader.next()); read.status == ReadStatus::kPacket; read = must(reader.next()))
    out.push_back({read.packet.type, {read.packet.payload.begin(), read.packet.payload.end()}});
  return out;
}

Bytes joined(const std::vector<Piece>& pieces) {
  Bytes out;
  write_signature(out);
  for (const Piece& p : pieces) write_packet(out, p.type, p.payload);
  return out;
}

std::size_t place_of(const std::vector<Piece>& pieces, PacketType type, int nth = 0) {
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].type == type && nth-- == 0) return i;
  give_up("a stream lacks a packet");
}

/// Offset of packet `nth` in the stream.
std::size_t offset_of(std::vector<Piece> pieces, std::size_t nth) {
  pieces.resize(nth);
  return joined(pieces).size();
}

/// Tracks of random knots at and between the limits of every number. No encoder writes such a group, but all
/// decoders must draw it alike.
MotionGroup group_at_limits(std::mt19937& random, const CodedLimits& limits, const CodedState& anchor) {
  MotionGroup group;
  group.anchor = anchor;
  group.pictures = 20;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    for (std::int32_t t = 0; t < group.pictures; ++t) {
      if (t + 1 < group.pictures && random() % 3 != 0) continue;
      Knot knot{.picture = t, .value = {}};
      for (std::size_t k = 0; k < kPartSizes[part]; ++k) {
        const std::size_t i = kPartFirst[part] + k;
        const auto range = static_cast<unsigned>(limits.max[i] - limits.min[i] + 1);
        knot.value[k] = random() % 6 == 0   ? limits.max[i]
                        : random() % 6 == 0 ? limits.min[i]
                                            : limits.min[i] + static_cast<int>(random() % range);
      }
      group.tracks[part].push_back(knot);
    }
  }
  return group;
}

/// All numbers of the state, at and between their limits.
Bytes limits_stream() {
  Setup setup;
  setup.format.width = 65;
  setup.format.height = 64;
  setup.format.frame_rate = {30, 1};
  setup.steps = {512, 4096, 1024, 256, 1024};
  std::mt19937 random(1);
  Geometry geometry;
  for (std::size_t v = 0; v < kVertexCount; ++v) geometry.positions[v] = generic_head().vertices[v].position;
  SurroundMap surround{7, 5, {}, {}};
  const auto share = [&] { return static_cast<std::uint8_t>(random() % (kFollowOne + 1)); };
  for (int k = 0; k < 8 * 6; ++k) {
    surround.head.push_back(share());
    surround.body.push_back(surround.head.back() == kFollowOne ? std::uint8_t{0} : share());
  }
  CodedState seen{};
  seen[kShiftX] = (32 << kScreenOneLog2) / setup.steps.translation;
  seen[kLogScale] = 4 * 4096 / setup.steps.log_scale;
  auto av1 = must(PatternEncoder::create(setup.format, 40));
  const Picture picture = pictures_of(talker_settings(65, 64, 1))[0];

  std::vector<Piece> pieces = {
      {PacketType::kSetup, must(encode_setup(setup))},
      {PacketType::kGeometry, must(encode_geometry(geometry)).payload},
      {PacketType::kSurround, must(encode_surround(surround))},
      {PacketType::kPattern, must(encode_pattern({0, seen, must(av1.encode(picture))}, setup))}};
  MotionEncoder coder(setup, seen);
  for (int i = 0; i < 2; ++i) {
    MotionGroup group = group_at_limits(random, coder.limits(), coder.anchor(i == 0));
    group.key = i == 0;
    pieces.push_back({PacketType::kMotion, must(coder.encode(group))});
  }
  return joined(pieces);
}

class Folder {
 public:
  explicit Folder(std::string path) : path_(std::move(path)), table_(path_ + "/vectors.txt") {
    table_
        << "# Written by make_vectors. File, first error, pictures, MD5 over the planes of all pictures.\n";
  }

  /// Writes a vector after checking that it decodes to the given number of pictures and error.
  void add(const std::string& file, const Bytes& bytes, std::uint64_t pictures,
           std::string_view error = "-") {
    const StreamDigest d = digest_of(bytes);
    if (d.error != error || d.pictures != pictures)
      give_up(file + " gives " + d.error + " and " + std::to_string(d.pictures) + " pictures");
    if (bytes.size() >= 8192) give_up(file + " is larger than 8 kB");
    std::ofstream(path_ + "/" + file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    table_ << file << ' ' << d.error << ' ' << d.pictures << ' ' << d.md5 << '\n';
    if (!table_) give_up("cannot write to " + path_);
  }

 private:
  std::string path_;
  std::ofstream table_;
};

void add_good(Folder& folder, const Bytes& talk) {
  folder.add("talk.fbs", talk, 20);
  auto turning = talker_settings(128, 96, 24);
  turning.motion = talker::Motion::kTurns;
  turning.yaw_deg = 25;
  turning.frame_rate = {6, 1};  // four seconds in 24 pictures
  folder.add("turns.fbs", encoded(pictures_of(turning), {}), 24);
  folder.add("odd.fbs", encoded(pictures_of(talker_settings(67, 65, 8)), {}), 8);
  folder.add("one.fbs", encoded(pictures_of(talker_settings(96, 80, 1)), {}), 1);

  std::vector<Picture> late(6, Picture(96, 80));
  for (const Picture& p : pictures_of(talker_settings(96, 80, 10))) late.push_back(p);
  folder.add("late.fbs", encoded(late, {}), 16);
  EncoderSettings anything;
  anything.allow_no_face = true;
  folder.add("nobody.fbs", encoded(std::vector<Picture>(4, Picture(64, 64)), anything), 4);
  std::vector<std::uint32_t> durations;
  for (std::uint32_t i = 0; i < 12; ++i) durations.push_back(i % 3 == 2 ? 6000 : 3000);
  folder.add("durations.fbs", encoded(pictures_of(talker_settings(96, 80, 12)), groups_of(4), durations), 12);
  folder.add("limits.fbs", limits_stream(), 40);

  auto pieces = pieces_of(talk);
  pieces[place_of(pieces, PacketType::kSetup)].payload.insert(pieces[0].payload.end(), {9, 9, 9});
  pieces[place_of(pieces, PacketType::kEnd)].payload.push_back(7);
  pieces.insert(pieces.begin() + 2, {static_cast<PacketType>(99), Bytes(40, 0x5A)});
  pieces.insert(pieces.begin(), {static_cast<PacketType>(7), {}});
  folder.add("later_writer.fbs", joined(pieces), 20);
}

void add_broken(Folder& folder, const Bytes& talk) {
  const auto pieces = pieces_of(talk);
  const std::size_t third_motion = offset_of(pieces, place_of(pieces, PacketType::kMotion, 2));
  folder.add("truncated.fbs", {talk.begin(), talk.begin() + third_motion + 5}, 6, "kTruncated");
  Bytes flipped = talk;
  flipped[offset_of(pieces, place_of(pieces, PacketType::kMotion, 1)) + 4] ^= 0x10;
  folder.add("flipped_bit.fbs", flipped, 1, "kInvalidStream");
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
  Bytes oversized = {kFormatVersion, kGenericHeadId, 0x80, 0x80, 0x01, 0x80, 0x80, 0x01};  // 16384 x 16384
  oversized.insert(oversized.end(), pieces[0].payload.begin() + 5, pieces[0].payload.end());
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
  const PatternSyntax pattern =
      must(decode_pattern(pieces[place_of(pieces, PacketType::kPattern)].payload, setup));
  PatternSyntax bad_av1 = pattern, wrong_size = pattern;
  bad_av1.av1.resize(pattern.av1.size() / 2);
  folder.add("bad_av1.fbs", with(PacketType::kPattern, must(encode_pattern(bad_av1, setup))), 0,
             "kInvalidStream");
  VideoFormat smaller = setup.format;
  smaller.width -= 2;
  wrong_size.av1 =
      must(must(PatternEncoder::create(smaller, 60)).encode(Picture(smaller.width, smaller.height)));
  folder.add("wrong_size.fbs", with(PacketType::kPattern, must(encode_pattern(wrong_size, setup))), 0,
             "kInvalidStream");
}

}  // namespace
}  // namespace fbs

int main(int argc, char** argv) {
  if (argc != 2) fbs::give_up("which folder?");
  fbs::Folder folder(argv[1]);
  const fbs::Bytes talk =
      fbs::encoded(fbs::pictures_of(fbs::talker_settings(128, 96, 20)), fbs::groups_of(5));
  fbs::add_good(folder, talk);
  fbs::add_broken(folder, talk);
  return 0;
}
