#include "decoder/sound/sound_decoder.h"

#include <gtest/gtest.h>

#include <random>

#include "bitstream/codec2_mode.h"
#include "tests/unit/encoder/sound/round_trip.h"

namespace fbs {
namespace {

using test::CodedSound;
using test::Samples;

constexpr SoundSetup kOpus{SoundCodec::kOpus, 1, 0, 960, 312};
constexpr SoundSetup kCodec2{SoundCodec::kCodec2, 1, 3200, 960, 960};

std::unique_ptr<SoundDecoder> decoder_of(const SoundSetup& setup) {
  auto decoder = SoundDecoder::create(setup);
  EXPECT_TRUE(decoder) << (decoder ? "" : decoder.error().text);
  return decoder ? std::move(*decoder) : nullptr;
}

ErrorCode error_of(const SoundSetup& setup) {
  const auto decoder = SoundDecoder::create(setup);
  return decoder ? ErrorCode::kInternal : decoder.error().code;
}

CodedSound voice_in(SoundCodec codec, int frame_ms = 20) {
  const SoundSettings settings{codec, 1, 12000, frame_ms};
  return test::code(settings, test::voice(test::rate_of(settings), 1));
}

Samples decoded(SoundDecoder& decoder, const SoundEncoder::Frames& frames) {
  Samples out;
  for (const auto& frame : frames) EXPECT_TRUE(decoder.decode(frame, out));
  return out;
}

/// A frame of 20 ms with `paddings` times 254 bytes of padding, one byte of length for each. RFC 6716, 3.2.5.
std::vector<std::uint8_t> padded_frame(std::size_t paddings) {
  std::vector<std::uint8_t> frame = {0x0B, 0x41};
  frame.insert(frame.end(), paddings, 0xFF);
  frame.resize(frame.size() + 1 + 8 + paddings * 254);
  return frame;
}

TEST(SoundDecoder, EachFrameGivesItsSamples) {
  for (const SoundCodec codec : {SoundCodec::kOpus, SoundCodec::kCodec2}) {
    const CodedSound sound = voice_in(codec);
    const auto decoder = decoder_of(sound.setup);
    EXPECT_EQ(decoder->channels(), 1);
    EXPECT_EQ(decoder->frame_samples(), codec == SoundCodec::kOpus ? 960U : 160U);
    Samples out(3, 7);
    EXPECT_TRUE(decoder->decode(sound.frames[0], out));
    EXPECT_TRUE(decoder->decode({}, out));
    EXPECT_EQ(out.size(), 3 + 2 * decoder->frame_samples());
    EXPECT_EQ(out[2], 7);
  }
}

TEST(SoundDecoder, WhatIsLostGoesOnAndFades) {
  for (const SoundCodec codec : {SoundCodec::kOpus, SoundCodec::kCodec2}) {
    const SoundSettings settings{codec, 1, 16000, 20};
    CodedSound sound = test::code(settings, test::vowel(test::rate_of(settings), 1));
    sound.frames.resize(20);
    const auto decoder = decoder_of(sound.setup);
    const Samples before = decoded(*decoder, sound.frames);
    const double loud = test::energy(std::span(before).last(decoder->frame_samples()));
    const Samples lost = decoded(*decoder, SoundEncoder::Frames(20));
    const auto frame = [&](std::size_t n) {
      return test::energy(std::span(lost).subspan(n * decoder->frame_samples(), decoder->frame_samples()));
    };
    EXPECT_GT(frame(0), loud / 4);
    EXPECT_LT(frame(0), loud * 2);
    EXPECT_LT(frame(4), loud / 2);
    EXPECT_LT(frame(19), loud / 1000);
  }
}

TEST(SoundDecoder, ALossBeforeTheFirstFrameIsSilence) {
  for (const SoundSetup& setup : {kOpus, kCodec2}) {
    const Samples out = decoded(*decoder_of(setup), SoundEncoder::Frames(3));
    EXPECT_EQ(test::energy(out), 0);
  }
}

TEST(SoundDecoder, AfterAResetNothingIsLeftOfBefore) {
  const CodedSound sound = voice_in(SoundCodec::kOpus);
  const auto decoder = decoder_of(sound.setup);
  const Samples first = decoded(*decoder, sound.frames);
  decoder->reset();
  EXPECT_EQ(decoded(*decoder, sound.frames), first);

  const CodedSound other = voice_in(SoundCodec::kCodec2);
  const auto second = decoder_of(other.setup);
  static_cast<void>(decoded(*second, other.frames));
  second->reset();
  EXPECT_EQ(test::energy(decoded(*second, SoundEncoder::Frames(2))), 0);  // nothing to go on from
}

TEST(SoundDecoder, RefusesOpusOfAnotherDuration) {
  const CodedSound longer = voice_in(SoundCodec::kOpus, 40);
  const auto decoder = decoder_of(kOpus);
  Samples out(1);
  const auto result = decoder->decode(longer.frames[3], out);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidStream);
  EXPECT_EQ(out.size(), 1U);
}

TEST(SoundDecoder, RefusesWhatIsNoFrame) {
  const auto refuses = [](const SoundSetup& setup, const std::vector<std::uint8_t>& frame) {
    Samples out(1);
    const auto result = decoder_of(setup)->decode(frame, out);
    return !result && result.error().code == ErrorCode::kInvalidStream && out.size() == 1;
  };
  EXPECT_TRUE(refuses(kOpus, {0x4B}));                                     // code 3 without a count of frames
  EXPECT_TRUE(refuses(kOpus, {0x0B, 0x41, 0xFF, 0xFF}));                   // padding beyond the end
  EXPECT_TRUE(refuses(kOpus, std::vector<std::uint8_t>(1 + 1276, 0x08)));  // longer than a frame can be
  EXPECT_FALSE(refuses(kOpus, padded_frame(240)));
  EXPECT_TRUE(refuses(kOpus, padded_frame(241)));  // right, but longer than what RFC 7845 takes
  EXPECT_TRUE(refuses(kCodec2, std::vector<std::uint8_t>(7)));
  EXPECT_TRUE(refuses(kCodec2, std::vector<std::uint8_t>(9)));
  EXPECT_FALSE(refuses(kCodec2, std::vector<std::uint8_t>(8)));
}

TEST(SoundDecoder, KnowsWhichSetupsThereAre) {
  for (const std::int32_t duration : {120, 240, 480, 960, 1920, 2880, 5760})
    EXPECT_EQ(decoder_of({SoundCodec::kOpus, 2, 0, duration, 0})->frame_samples(),
              static_cast<std::size_t>(duration));
  for (const Codec2Mode& mode : codec2_modes())
    EXPECT_EQ(decoder_of({SoundCodec::kCodec2, 1, mode.bitrate, mode.duration(), 960})->frame_samples(),
              mode.frame_samples);

  const SoundCodec opus = SoundCodec::kOpus, codec2 = SoundCodec::kCodec2;
  EXPECT_EQ(error_of({static_cast<SoundCodec>(3), 1, 0, 960, 0}), ErrorCode::kUnsupported);
  EXPECT_EQ(error_of({opus, 3, 0, 960, 0}), ErrorCode::kUnsupported);
  EXPECT_EQ(error_of({opus, 1, 1, 960, 0}), ErrorCode::kUnsupported);
  EXPECT_EQ(error_of({codec2, 2, 3200, 960, 0}), ErrorCode::kUnsupported);
  EXPECT_EQ(error_of({codec2, 1, 700, 1920, 0}), ErrorCode::kUnsupported);
  EXPECT_EQ(error_of({codec2, 1, 3200, 1920, 0}), ErrorCode::kInvalidStream);
  for (const std::int32_t duration : {0, -120, 60, 961, 5880})
    EXPECT_EQ(error_of({opus, 1, 0, duration, 0}), ErrorCode::kInvalidStream) << duration;
  EXPECT_EQ(error_of({opus, 1, 0, 960, -1}), ErrorCode::kInvalidStream);
  EXPECT_EQ(error_of({opus, 1, 0, 960, kMaxSoundSkip + 1}), ErrorCode::kInvalidStream);
}

TEST(SoundDecoder, TakesAnyBytes) {
  std::mt19937 random(3);
  for (const SoundSetup& setup : {kOpus, SoundSetup{SoundCodec::kOpus, 2, 0, 2880, 0}, kCodec2,
                                  SoundSetup{SoundCodec::kCodec2, 1, 1600, 1920, 0},
                                  SoundSetup{SoundCodec::kCodec2, 1, 1200, 1920, 0}}) {
    const auto decoder = decoder_of(setup);
    const std::size_t expected = decoder->frame_samples() * static_cast<std::size_t>(setup.channels);
    int right = 0;
    for (int i = 0; i < 10000; ++i) {
      std::vector<std::uint8_t> frame(
          setup.codec == SoundCodec::kCodec2 ? find_codec2_mode(setup.mode)->frame_bytes : 1 + random() % 80);
      for (std::uint8_t& byte : frame) byte = static_cast<std::uint8_t>(random());
      Samples out;
      const auto result = decoder->decode(frame, out);
      ASSERT_EQ(out.size(), result ? expected : 0);
      ASSERT_TRUE(result || result.error().code == ErrorCode::kInvalidStream);
      right += result ? 1 : 0;
    }
    EXPECT_GT(right, setup.codec == SoundCodec::kCodec2 ? 9999 : 100);
  }
}

TEST(SoundDecoder, AVoiceComesBackAfterAnyBytes) {
  std::mt19937 random(4);
  for (const SoundSettings& settings :
       {SoundSettings{SoundCodec::kOpus, 1, 12000, 20}, SoundSettings{SoundCodec::kCodec2, 1, 3200, 20},
        SoundSettings{SoundCodec::kCodec2, 1, 2400, 20}, SoundSettings{SoundCodec::kCodec2, 1, 1600, 20},
        SoundSettings{SoundCodec::kCodec2, 1, 1200, 20}}) {
    const CodedSound sound = test::code(settings, test::voice(test::rate_of(settings), 2));
    const Samples whole = decoded(*decoder_of(sound.setup), sound.frames);
    const auto decoder = decoder_of(sound.setup);
    Samples out;
    for (int i = 0; i < 300; ++i) {
      std::vector<std::uint8_t> frame(sound.frames[1].size());
      for (std::uint8_t& byte : frame) byte = static_cast<std::uint8_t>(random());
      if (settings.codec == SoundCodec::kOpus) frame[0] = sound.frames[1][0];  // the mode
      static_cast<void>(decoder->decode(frame, out));
    }
    const Samples after = decoded(*decoder, sound.frames);
    const std::size_t second = whole.size() / 2;  // levels settle within the first
    const double loud = test::energy(std::span(whole).last(second));
    EXPECT_NEAR(10 * std::log10(test::energy(std::span(after).last(second)) / loud), 0, 1)
        << static_cast<int>(settings.codec) << " " << settings.bitrate;
  }
}

}  // namespace
}  // namespace fbs
