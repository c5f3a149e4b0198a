#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "bitstream/packet.h"
#include "decoder/sound/sound_reader.h"
#include "decoder/stream/stream_decoder.h"
#include "fbs/sound.h"
#include "tests/unit/library/api_decoder.h"

namespace fbs {
namespace {

constexpr std::uint64_t kForever = ~std::uint64_t{0};

struct Close {
  void operator()(fbs_sound* sound) const { fbs_sound_close(&sound); }
};
using Sound = std::unique_ptr<fbs_sound, Close>;

Sound open_sound(const std::vector<std::uint8_t>& bytes = {}) {
  fbs_sound* sound = nullptr;
  EXPECT_EQ(fbs_sound_open(&sound), FBS_OK);
  EXPECT_EQ(fbs_sound_feed(sound, bytes.data(), bytes.size()), FBS_OK);
  return Sound(sound);
}

fbs_sound_info info_of(const Sound& sound) {
  fbs_sound_info info;
  EXPECT_EQ(fbs_sound_get_info(sound.get(), &info), FBS_OK);
  return info;
}

/// Appends the samples up to a time to `out`, and returns when they begin.
std::uint64_t take(const Sound& sound, std::uint64_t end, std::vector<std::int16_t>& out) {
  fbs_samples samples{};
  EXPECT_EQ(fbs_sound_take(sound.get(), end, &samples), FBS_OK);
  out.insert(out.end(), samples.data, samples.data + samples.count * samples.channels);
  return samples.time;
}

/// What the decoder of pictures hands out and SoundReader decodes, without gaps.
std::vector<std::int16_t> read_beside_pictures(const std::vector<std::uint8_t>& bytes) {
  StreamDecoder decoder;
  decoder.keep_sound();
  decoder.feed(bytes);
  decoder.close();
  SoundReader reader;
  std::vector<std::int16_t> out;
  for (;;) {
    const auto status = decoder.next();
    for (SoundPart& part : decoder.take_sound()) {
      EXPECT_TRUE(reader.set(part.setup) && reader.add(std::move(part.group)));
      SoundPiece piece;
      while (*reader.next(piece)) out.insert(out.end(), piece.samples.begin(), piece.samples.end());
    }
    if (!status || *status == DecodeStatus::kEnd) return out;
  }
}

TEST(SoundApi, GivesTheSamplesThatComeWithThePictures) {
  const auto bytes = vector_bytes("sound_opus.fbs");
  std::vector<std::int16_t> all;
  EXPECT_EQ(take(open_sound(bytes), kForever, all), 0u);
  EXPECT_GT(*std::ranges::max_element(all), 1000) << "it is not silent";
  EXPECT_EQ(all, read_beside_pictures(bytes));
}

TEST(SoundApi, KnowsBothCodecs) {
  for (const auto& [name, rate] :
       {std::pair("sound_opus.fbs", 48000u), std::pair("sound_codec2.fbs", 8000u)}) {
    const auto bytes = vector_bytes(name);
    const Sound sound = open_sound(bytes);
    EXPECT_EQ(info_of(sound).sample_rate, rate);
    std::vector<std::int16_t> all;
    take(sound, kForever, all);
    EXPECT_EQ(all.size(), read_beside_pictures(bytes).size()) << name;  // codec2 draws random phases
  }
}

TEST(SoundApi, PiecesAreTheWhole) {
  const auto bytes = vector_bytes("sound_opus.fbs");
  std::vector<std::int16_t> whole, pieces;
  take(open_sound(bytes), kForever, whole);
  const Sound sound = open_sound();
  std::uint64_t end = 0;
  for (const std::uint8_t byte : bytes) {
    ASSERT_EQ(fbs_sound_feed(sound.get(), &byte, 1), FBS_OK);
    const fbs_sound_info info = info_of(sound);
    if (info.sample_rate == 0) continue;
    const std::size_t before = pieces.size() / info.channels;
    EXPECT_EQ(take(sound, end += 40, pieces), before * FBS_SOUND_TICKS_PER_SECOND / info.sample_rate);
  }
  take(sound, kForever, pieces);
  EXPECT_EQ(pieces, whole);
}

TEST(SoundApi, GoesOnFromAnyTime) {
  const auto bytes = vector_bytes("sound_opus.fbs");
  std::vector<std::int16_t> whole, rest;
  const Sound sound = open_sound(bytes);
  take(sound, kForever, whole);
  ASSERT_EQ(fbs_sound_seek(sound.get(), 9000), FBS_OK);
  EXPECT_EQ(take(sound, kForever, rest), 4800u);
  whole.erase(whole.begin(), whole.begin() + 4800 * static_cast<std::ptrdiff_t>(info_of(sound).channels));
  EXPECT_EQ(rest, whole);
}

TEST(SoundApi, TellsWhatHasCome) {
  const auto bytes = vector_bytes("sound_opus.fbs");
  const Sound sound = open_sound();
  fbs_samples samples;
  EXPECT_EQ(info_of(sound).shown_until, 0u);
  EXPECT_EQ(fbs_sound_take(sound.get(), 90000, &samples), FBS_NEED_DATA);
  ASSERT_EQ(fbs_sound_feed(sound.get(), bytes.data(), bytes.size()), FBS_OK);
  const fbs_sound_info info = info_of(sound);
  const auto pictures = heard(bytes).infos;
  EXPECT_EQ(info.shown_until, pictures.back().time + pictures.back().duration);
  EXPECT_GT(info.bytes, 100u);
  EXPECT_LT(info.bytes, bytes.size());
  EXPECT_EQ(info_of(open_sound(vector_bytes("talk.fbs"))).bytes, 0u);
}

TEST(SoundApi, WhatIsLostIsSilence) {
  auto bytes = vector_bytes("sound_opus.fbs");
  std::vector<std::int16_t> whole, damaged;
  take(open_sound(bytes), kForever, whole);
  PacketReader packets(bytes);
  std::uint64_t damage = 0;  // in the middle one of the sound packets, or the one after
  for (auto read = packets.next(); read && read->status == ReadStatus::kPacket; read = packets.next())
    if (read->packet.type == PacketType::kSound && damage < bytes.size() / 2)
      damage = read->packet.offset + read->packet.size / 2;
  bytes[damage] ^= 0x55;
  take(open_sound(bytes), kForever, damaged);
  ASSERT_LT(damaged.size(), whole.size());
  const auto lost = std::ranges::mismatch(damaged, whole).in1;
  EXPECT_GT(lost - damaged.begin(), 4800) << "what came before is heard";
  EXPECT_GT(damaged.end() - lost, 4800);
  EXPECT_TRUE(std::all_of(lost, damaged.end(), [](std::int16_t sample) { return sample == 0; }));
}

TEST(SoundApi, RefusesNullPointers) {
  EXPECT_EQ(fbs_sound_open(nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_sound_feed(nullptr, nullptr, 0), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_sound_seek(nullptr, 0), FBS_ERROR_ARGUMENT);
  EXPECT_STREQ(fbs_sound_error(nullptr), "");
  fbs_sound_close(nullptr);
  const Sound sound = open_sound();
  EXPECT_EQ(fbs_sound_feed(sound.get(), nullptr, 1), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_sound_get_info(sound.get(), nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_sound_take(sound.get(), 0, nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_STRNE(fbs_sound_error(sound.get()), "");
}

}  // namespace
}  // namespace fbs
