#include "tests/vectors/vector_tools.h"

#include <cstdlib>
#include <iostream>
#include <optional>
#include <span>

#include "bitstream/byte_io.h"
#include "bitstream/motion/motion_decoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/setup_payload.h"
#include "tests/talker/talker_render.h"
#include "tests/unit/encode_decode.h"
#include "tests/vectors/stream_digest.h"

namespace fbs {

void give_up(const std::string& why) {
  std::cerr << "make_vectors: " << why << '\n';
  std::exit(1);
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

EncoderSettings one_pattern(int group_pictures) {
  EncoderSettings s;
  s.patterns = 1;
  s.group_pictures = group_pictures;
  return s;
}

Bytes encoded(const std::vector<Picture>& pictures, const EncoderSettings& settings,
              const std::vector<std::uint32_t>& durations) {
  VideoFormat format;
  format.width = pictures[0].width();
  format.height = pictures[0].height();
  format.frame_rate = {30, 1};
  return must(encode_pictures(format, settings, pictures, durations));
}

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
  PacketWriter writer;
  for (const Piece& p : pieces) writer.write(out, p.type, p.payload);
  return out;
}

std::size_t place_of(const std::vector<Piece>& pieces, PacketType type, int nth) {
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].type == type && nth-- == 0) return i;
  give_up("a stream lacks a packet");
}

std::size_t offset_of(std::vector<Piece> pieces, std::size_t nth) {
  pieces.resize(nth);
  return joined(pieces).size();
}

Bytes joined_without(const std::vector<Piece>& pieces, std::size_t nth) {
  Bytes stream = joined(pieces);
  stream.erase(stream.begin() + offset_of(pieces, nth), stream.begin() + offset_of(pieces, nth + 1));
  return stream;
}

Bytes joined_from(const std::vector<Piece>& pieces, std::size_t nth) {
  const Bytes whole = joined(pieces);
  return {whole.begin() + offset_of(pieces, nth), whole.end()};
}

Bytes joined_with_two(const std::vector<Piece>& pieces, std::size_t nth) {
  const Bytes whole = joined(pieces);
  Bytes stream(whole.begin(), whole.begin() + offset_of(pieces, nth + 1));
  stream.insert(stream.end(), whole.begin() + offset_of(pieces, nth), whole.end());
  return stream;
}

namespace {

/// The motion that a packet has.
std::optional<std::span<const std::uint8_t>> motion_of(const Piece& piece) {
  if (piece.type == PacketType::kMotion) return piece.payload;
  if (piece.type != PacketType::kUnit) return std::nullopt;
  ByteReader reader(piece.payload);
  return reader.bytes(reader.varint());
}

}  // namespace

std::vector<PatternPiece> patterns_of(const std::vector<Piece>& pieces) {
  const Setup setup = must(decode_setup(pieces[place_of(pieces, PacketType::kSetup)].payload));
  std::vector<PatternPiece> out;
  PatternPacketReader reader;
  std::optional<MotionDecoder> motion;
  std::int32_t pictures = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (const auto moves = motion_of(pieces[i])) pictures += must(motion->decode(*moves))->pictures;
    if (pieces[i].type != PacketType::kPattern) continue;
    out.push_back({i, must(reader.decode(pieces[i].payload, setup, pictures)), pictures});
    if (!motion) motion.emplace(setup, out.front().patterns.front().state);
  }
  return out;
}

Folder::Folder(std::string path) : path_(std::move(path)), table_(path_ + "/vectors.txt") {
  table_ << "# Written by make_vectors. File, first error, pictures, MD5 over the planes of all pictures.\n";
}

void Folder::add(const std::string& file, const Bytes& bytes, std::uint64_t pictures,
                 std::string_view error) {
  std::ofstream(path_ + "/" + file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  const StreamDigest d = digest_of(bytes);
  if (d.error != error || d.pictures != pictures)
    give_up(file + " gives " + d.error + " and " + std::to_string(d.pictures) + " pictures");
  if (bytes.size() >= 8192) give_up(file + " is larger than 8 kB");
  table_ << file << ' ' << d.error << ' ' << d.pictures << ' ' << d.md5 << '\n';
  if (!table_) give_up("cannot write to " + path_);
}

}  // namespace fbs
