#include "tests/vectors/sound_digest.h"

#include <fstream>
#include <sstream>
#include <utility>

#include "common/md5.h"
#include "decoder/sound/sound_reader.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs {
namespace {

std::uint64_t samples_of(SoundReader& reader, SoundPart part) {
  std::uint64_t samples = 0;
  if (!reader.set(part.setup) || !reader.add(std::move(part.group))) return samples;
  SoundPiece piece;
  for (;;) {
    const auto more = reader.next(piece);
    if (more && !*more) return samples;
    if (more) samples += piece.samples.size() / static_cast<std::size_t>(piece.channels);
  }
}

}  // namespace

SoundDigest sound_digest_of(std::span<const std::uint8_t> stream) {
  StreamDecoder decoder;
  decoder.keep_sound();
  decoder.feed(stream);
  decoder.close();
  SoundReader reader;
  SoundDigest out;
  Md5 md5;
  for (bool more = true; more;) {
    const auto status = decoder.next();
    more = !status || *status != DecodeStatus::kEnd;
    for (SoundPart& part : decoder.take_sound()) {
      out.frames += part.group.frames.size();
      for (const auto& frame : part.group.frames) md5.add(frame);
      out.samples += samples_of(reader, std::move(part));
    }
  }
  out.md5 = md5.hex();
  return out;
}

std::vector<SoundVector> read_sound_vectors(const std::string& folder) {
  std::ifstream table(folder + "/sound.txt");
  std::vector<SoundVector> out;
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    SoundVector v;
    if (fields >> v.file >> v.expected.frames >> v.expected.samples >> v.expected.md5) out.push_back(v);
  }
  return out;
}

}  // namespace fbs
