// Bytes to sound: setups and groups of frames for a reader of sound. First a setup: codec, channels less one,
// mode (index in a list, or the mode itself), duration in 2.5 ms, skip of two bytes. Then steps, each a byte:
// 0xFF a setup again; 0xFE a reset; 0xFD a jump by two bytes; else the length of a frame in bytes, 0 a lost
// one, 0xFC two bytes of length.
#include <algorithm>
#include <array>
#include <utility>

#include "bitstream/byte_io.h"
#include "decoder/sound/sound_reader.h"
#include "encoder/sound/sound_encoder.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

constexpr std::array<std::int32_t, 7> kModes = {0, 3200, 2400, 1600, 1400, 1300, 1200};
constexpr std::int32_t kStep = 120;               // 1/kSoundClock s
constexpr int kMaxSteps = 64, kMaxPieces = 4000;  // of an input; a gap may be endless

fbs::SoundSetup read_setup(fbs::ByteReader& reader) {
  fbs::SoundSetup setup;
  setup.codec = static_cast<fbs::SoundCodec>(reader.u8());
  setup.channels = reader.u8() - 1;
  const std::uint8_t mode = reader.u8();
  setup.mode = mode < kModes.size() ? kModes[mode] : mode;
  setup.duration = reader.u8() * kStep;
  setup.skip = reader.u16();
  return setup;
}

void write_setup(const fbs::SoundSetup& setup, fbs::ByteWriter& writer) {
  writer.u8(static_cast<std::uint8_t>(setup.codec));
  writer.u8(static_cast<std::uint8_t>(setup.channels + 1));
  writer.u8(static_cast<std::uint8_t>(std::find(kModes.begin(), kModes.end(), setup.mode) - kModes.begin()));
  writer.u8(static_cast<std::uint8_t>(setup.duration / kStep));
  writer.u16(static_cast<std::uint16_t>(setup.skip));
}

/// Frames of a buzz, a loss and a jump among them.
fbs::fuzz::Bytes seed_of(const fbs::SoundSettings& settings) {
  const auto encoder = fbs::SoundEncoder::create(settings);
  require(encoder.has_value(), "no encoder");
  std::vector<std::int16_t> samples(
      static_cast<std::size_t>((*encoder)->sample_rate() * settings.channels / 2));
  for (std::size_t i = 0; i < samples.size(); ++i)
    samples[i] = static_cast<std::int16_t>(i * 160 % 16000 + i * i % 999);
  fbs::SoundEncoder::Frames frames;
  require((*encoder)->add(samples, frames) && (*encoder)->finish(frames), "no frames");

  fbs::fuzz::Bytes seed;
  fbs::ByteWriter writer(seed);
  write_setup((*encoder)->setup(), writer);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (i == 4) writer.u8(0);
    if (i == 6) {
      writer.u8(0xFD);
      writer.u16(3);
    }
    writer.u8(0xFC);
    writer.u16(static_cast<std::uint16_t>(frames[i].size()));
    writer.bytes(frames[i]);
  }
  return seed;
}

/// Checks the invariants of all pieces that a reader gives.
class Listener {
 public:
  explicit Listener(fbs::SoundReader& reader) : reader_(reader) {}

  void seek() { end_ = -1; }

  /// @return false when there was enough
  bool listen(const fbs::SoundSetup& setup) {
    const std::size_t errors_before = errors_;
    while (pieces_++ < kMaxPieces) {
      const auto more = reader_.next(piece_);
      if (more && !*more) return true;
      if (more)
        check(setup);
      else
        require(more.error().code == fbs::ErrorCode::kInvalidStream && ++errors_ == errors_before + 1,
                "more errors than frames");
    }
    return false;
  }

 private:
  void check(const fbs::SoundSetup& setup) {
    const std::int64_t ticks = fbs::kSoundClock / piece_.sample_rate;
    const auto samples = static_cast<std::int64_t>(piece_.samples.size()) / piece_.channels;
    require(piece_.channels == setup.channels && samples * piece_.channels == std::ssize(piece_.samples),
            "channels");
    require(samples > 0 && samples * ticks <= setup.duration, "a piece of another size");
    require(piece_.time >= 0 && (end_ < 0 || (piece_.time >= end_ && piece_.time < end_ + ticks)),
            "a gap in time");
    end_ = piece_.time + samples * ticks;
  }

  fbs::SoundReader& reader_;
  fbs::SoundPiece piece_;
  std::int64_t end_ = -1;  // of the pieces so far; -1: anything may come
  std::size_t errors_ = 0;
  int pieces_ = 0;
};

}  // namespace

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes&) {
  static bool given = false;  // the same for all streams
  if (std::exchange(given, true)) return {};
  constexpr SoundCodec kOpus = SoundCodec::kOpus, kCodec2 = SoundCodec::kCodec2;
  return {seed_of({kOpus, 1, 6000, 60}),   seed_of({kOpus, 1, 12000, 20}),  seed_of({kOpus, 2, 32000, 10}),
          seed_of({kOpus, 2, 64000, 40}),  seed_of({kCodec2, 1, 3200, 20}), seed_of({kCodec2, 1, 2400, 20}),
          seed_of({kCodec2, 1, 1600, 20}), seed_of({kCodec2, 1, 1400, 20}), seed_of({kCodec2, 1, 1200, 20})};
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fbs::ByteReader bytes({data, size});
  fbs::SoundReader reader;
  Listener listener(reader);
  fbs::SoundSetup setup = read_setup(bytes);
  bool known = reader.set(setup).has_value();
  std::int64_t number = 0;
  for (int steps = 0; steps < kMaxSteps && bytes.remaining() > 0; ++steps) {
    const std::uint8_t step = bytes.u8();
    if (step == 0xFF) {
      setup = read_setup(bytes);
      known = reader.set(setup).has_value();
    } else if (step == 0xFE) {
      reader.reset();
      listener.seek();
    } else if (step == 0xFD) {
      number += static_cast<std::int16_t>(bytes.u16());
    } else {
      const std::size_t length = std::min<std::size_t>(step == 0xFC ? bytes.u16() : step, bytes.remaining());
      const auto frame = bytes.bytes(length);
      const bool taken = reader.add({number, {{frame.begin(), frame.end()}}}).has_value();
      require(taken == (known && number >= 0), "a group taken out of place");
      ++number;
      if (!listener.listen(setup)) break;
    }
  }
  return 0;
}
