// Codes sound and decodes it again: sound_tool opus|codec2 BITRATE FRAME_MS <IN >OUT. IN and OUT are mono
// samples, 16 bits in this machine's byte order, at 48 kHz (opus) or 8 kHz (codec2). Prints a line for
// measure_sound.py: sample rate, bytes, frames, duration of a frame (1/48000 s), skip.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "decoder/sound/sound_reader.h"
#include "encoder/sound/sound_encoder.h"

namespace {

std::vector<std::int16_t> read_all() {
  std::vector<std::int16_t> samples(1 << 16);
  std::size_t size = 0;
  while (const std::size_t read = std::fread(samples.data() + size, 2, samples.size() - size, stdin)) {
    size += read;
    samples.resize(size + (1 << 16));
  }
  samples.resize(size);
  return samples;
}

template <class T>
T taken(fbs::Result<T> result) {
  if (result) return std::move(*result);
  std::fprintf(stderr, "sound_tool: %s\n", result.error().text.c_str());
  std::_Exit(2);
}

void taken(fbs::Result<void> result) {
  taken(result.map([] { return 0; }));
}

void write_decoded(const fbs::SoundSetup& setup, fbs::SoundEncoder::Frames frames) {
  fbs::SoundReader reader;
  taken(reader.set(setup));
  taken(reader.add({0, std::move(frames)}));
  for (fbs::SoundPiece piece; taken(reader.next(piece));)
    std::fwrite(piece.samples.data(), 2, piece.samples.size(), stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const std::string codec = argv[1];
  const auto kind = codec == "opus" ? fbs::SoundCodec::kOpus : fbs::SoundCodec::kCodec2;
  const auto encoder = taken(fbs::SoundEncoder::create({kind, 1, std::atoi(argv[2]), std::atoi(argv[3])}));
  fbs::SoundEncoder::Frames frames;
  taken(encoder->add(read_all(), frames));
  taken(encoder->finish(frames));
  std::size_t bytes = 0;
  for (const auto& frame : frames) bytes += frame.size();
  const fbs::SoundSetup& setup = encoder->setup();
  std::fprintf(stderr, "%d %zu %zu %d %d\n", encoder->sample_rate(), bytes, frames.size(), setup.duration,
               setup.skip);
  write_decoded(setup, std::move(frames));
}
