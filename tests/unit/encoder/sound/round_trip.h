// Sound to frames and back.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "decoder/sound/sound_reader.h"
#include "encoder/sound/sound_encoder.h"
#include "tests/unit/encoder/sound/voice.h"

namespace fbs::test {

struct CodedSound {
  SoundSetup setup;
  SoundEncoder::Frames frames;

  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& frame : frames) sum += frame.size();
    return sum;
  }
  /// bit/s, over the time that the frames last.
  [[nodiscard]] double rate() const {
    return static_cast<double>(bytes()) * 8 * kSoundClock /
           (static_cast<double>(frames.size()) * setup.duration);
  }
};

inline int rate_of(const SoundSettings& settings) {
  return settings.codec == SoundCodec::kOpus ? 48000 : 8000;
}

/// @param step  samples of each call; 0: all at once
inline CodedSound code(const SoundSettings& settings, std::span<const std::int16_t> samples,
                       std::size_t step = 0) {
  const auto encoder = SoundEncoder::create(settings);
  if (!encoder) {
    ADD_FAILURE() << encoder.error().text;
    return {};
  }
  EXPECT_EQ((*encoder)->sample_rate(), rate_of(settings));
  CodedSound out{(*encoder)->setup(), {}};
  if (step == 0) step = std::max<std::size_t>(1, samples.size());
  for (std::size_t i = 0; i < samples.size(); i += step)
    EXPECT_TRUE((*encoder)->add(samples.subspan(i, std::min(step, samples.size() - i)), out.frames));
  EXPECT_TRUE((*encoder)->finish(out.frames));
  return out;
}

/// The remaining samples, which must be read without errors and without gaps.
inline Samples read_rest(SoundReader& reader, std::int64_t* begin = nullptr) {
  Samples out;
  SoundPiece piece;
  std::int64_t end = 0;
  for (auto more = reader.next(piece); !more || *more; more = reader.next(piece)) {
    if (!more) {
      ADD_FAILURE() << more.error().text;
      break;
    }
    EXPECT_FALSE(piece.samples.empty());
    if (out.empty()) {
      if (begin != nullptr) *begin = piece.time;
    } else {
      EXPECT_EQ(piece.time, end);
    }
    end = piece.time + static_cast<std::int64_t>(piece.samples.size()) / piece.channels *
                           (kSoundClock / piece.sample_rate);
    out.insert(out.end(), piece.samples.begin(), piece.samples.end());
  }
  return out;
}

inline Samples decode(const CodedSound& sound) {
  SoundReader reader;
  EXPECT_TRUE(reader.set(sound.setup));
  EXPECT_TRUE(reader.add({0, sound.frames}));
  return read_rest(reader);
}

}  // namespace fbs::test
