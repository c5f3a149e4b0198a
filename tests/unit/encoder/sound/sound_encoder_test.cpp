#include "encoder/sound/sound_encoder.h"

#include <gtest/gtest.h>

#include "bitstream/codec2_mode.h"
#include "tests/unit/encoder/sound/round_trip.h"

namespace fbs {
namespace {

using test::CodedSound;
using test::Samples;

constexpr SoundSettings kCodec2{SoundCodec::kCodec2, 1, 3200, 20};
constexpr int kFrameMs[] = {10, 20, 40, 60};
constexpr int kCodec2Rates[] = {3200, 2400, 1600, 1400, 1200};

TEST(SoundEncoder, OpusIsInStepWithTheSource) {
  const Samples source = test::voice(48000, 1.5);
  for (const int frame_ms : kFrameMs) {
    const Samples decoded = test::decode(test::code({SoundCodec::kOpus, 1, 16000, frame_ms}, source));
    const auto found = test::align(source, decoded, 480);
    EXPECT_LE(std::abs(found.lag), 48) << frame_ms;
    EXPECT_GT(found.correlation, 0.8) << frame_ms;
  }
}

TEST(SoundEncoder, Codec2IsInStepWithTheSource) {
  const Samples source = test::voice(8000, 12);
  for (const int bitrate : kCodec2Rates) {
    const Samples decoded = test::decode(test::code({SoundCodec::kCodec2, 1, bitrate, 20}, source));
    const auto found = test::align(test::envelope(source, 8000), test::envelope(decoded, 8000), 40);
    EXPECT_LE(std::abs(found.lag), 1) << bitrate;
    EXPECT_GT(found.correlation, 0.9) << bitrate;
  }
}

TEST(SoundEncoder, TheEndIsInStepToo) {
  for (const SoundSettings& settings : {SoundSettings{}, kCodec2}) {
    const int rate = test::rate_of(settings);
    Samples source(static_cast<std::size_t>(rate) * 3);
    const Samples word = test::voice(rate, 0.3);
    std::copy(word.begin(), word.end(), source.end() - static_cast<std::ptrdiff_t>(word.size()));
    const Samples decoded = test::decode(test::code(settings, source));
    const auto tail = std::span(decoded).subspan(source.size() - word.size());
    EXPECT_GT(test::energy(tail), test::energy(word) / 4);
    EXPECT_LT(test::energy(std::span(decoded).first(static_cast<std::size_t>(rate) * 5 / 2)),
              test::energy(word) / 1000);
  }
}

TEST(SoundEncoder, OpusKeepsTheLevelOfASweep) {
  constexpr int kRate = 48000;
  const Samples source = test::sweep(kRate, 2, 200, 3400);
  const Samples decoded = test::decode(test::code({SoundCodec::kOpus, 1, 24000, 20}, source));
  for (std::size_t i = kRate / 10; i + kRate / 10 <= source.size(); i += kRate / 10) {
    const double before = test::energy(std::span(source).subspan(i, kRate / 10));
    const double after = test::energy(std::span(decoded).subspan(i, kRate / 10));
    EXPECT_NEAR(10 * std::log10(after / before), 0, 2) << i;
  }
}

TEST(SoundEncoder, Codec2KeepsTheLevelOfAVoice) {
  const Samples source = test::voice(8000, 6);
  for (const int bitrate : kCodec2Rates) {
    const Samples decoded = test::decode(test::code({SoundCodec::kCodec2, 1, bitrate, 20}, source));
    EXPECT_NEAR(10 * std::log10(test::energy(decoded) / test::energy(source)), 0, 3) << bitrate;
  }
}

TEST(SoundEncoder, AllSamplesComeBackAndLessThanAFrameMore) {
  for (const SoundSettings& settings : {SoundSettings{SoundCodec::kOpus, 1, 12000, 10}, SoundSettings{},
                                        SoundSettings{SoundCodec::kOpus, 2, 24000, 20}, kCodec2,
                                        SoundSettings{SoundCodec::kCodec2, 1, 1200, 20}}) {
    const auto channels = static_cast<std::size_t>(settings.channels);
    for (const std::size_t size : {1, 159, 160, 161, 312, 2880, 4801}) {
      const CodedSound sound = test::code(settings, Samples(size * channels, 100));
      const std::size_t frame = static_cast<std::size_t>(sound.setup.duration) * channels *
                                static_cast<std::size_t>(test::rate_of(settings)) / kSoundClock;
      const std::size_t decoded = test::decode(sound).size();
      EXPECT_GE(decoded, size * channels);
      EXPECT_LT(decoded, size * channels + frame) << size;
    }
  }
}

TEST(SoundEncoder, SamplesMayComeInAnyPortions) {
  for (const SoundSettings& settings : {SoundSettings{SoundCodec::kOpus, 2, 24000, 20}, kCodec2}) {
    const Samples source = test::voice(test::rate_of(settings), 0.5);
    const CodedSound whole = test::code(settings, source);
    for (const std::size_t step : {1, 7, 1000})
      EXPECT_EQ(test::code(settings, source, step).frames, whole.frames);
  }
}

TEST(SoundEncoder, NoSamplesNoFrames) {
  EXPECT_TRUE(test::code({}, {}).frames.empty());
  EXPECT_TRUE(test::code(kCodec2, {}).frames.empty());
}

TEST(SoundEncoder, OpusTakesTheRateThatIsAskedFor) {
  const Samples source = test::speech_noise(48000, 10);
  for (const int frame_ms : {20, 60})
    for (const int bitrate : {6000, 8000, 12000, 16000}) {
      const double rate = test::code({SoundCodec::kOpus, 1, bitrate, frame_ms}, source).rate();
      EXPECT_NEAR(rate / bitrate, 1, 0.15) << bitrate << " of " << frame_ms << " ms";
    }
}

TEST(SoundEncoder, Codec2TakesExactlyTheRateOfItsMode) {
  const Samples source = test::voice(8000, 2);
  for (const int bitrate : kCodec2Rates) {
    const CodedSound sound = test::code({SoundCodec::kCodec2, 1, bitrate, 20}, source);
    EXPECT_EQ(sound.rate(), bitrate);
    EXPECT_EQ(sound.setup.mode, bitrate);
  }
}

TEST(SoundEncoder, Codec2TakesTheModeThatIsNotAbove) {
  const auto mode = [](int bitrate) {
    const auto encoder = SoundEncoder::create({SoundCodec::kCodec2, 1, bitrate, 20});
    return encoder ? (*encoder)->setup().mode : 0;
  };
  EXPECT_EQ(mode(64000), 3200);
  EXPECT_EQ(mode(3199), 2400);
  EXPECT_EQ(mode(1599), 1400);
  EXPECT_EQ(mode(1399), 1200);  // frames of mode 1300 take 1400 bit/s
  EXPECT_EQ(mode(1199), 0);
}

TEST(SoundEncoder, APauseCostsNextToNothing) {
  const CodedSound sound = test::code({}, Samples(48000 * 6));
  EXPECT_LT(sound.rate(), 1000);
  const auto& last = sound.frames.back();
  EXPECT_GE(last.size(), 1U);
  EXPECT_LE(last.size(), 2U);
}

TEST(SoundEncoder, ChannelsStayApart) {
  const Samples left = test::voice(48000, 1);
  Samples source;
  for (const std::int16_t sample : left) source.insert(source.end(), {sample, 0});
  const Samples decoded = test::decode(test::code({SoundCodec::kOpus, 2, 64000, 20}, source));
  Samples heard[2];
  for (std::size_t i = 0; i < decoded.size(); ++i) heard[i % 2].push_back(decoded[i]);
  EXPECT_GT(test::energy(heard[0]), 20 * test::energy(heard[1]));
}

TEST(SoundEncoder, ModesAreAsLibcodec2SaysThem) {
  for (const Codec2Mode& mode : codec2_modes()) {
    EXPECT_EQ(find_codec2_mode(mode.bitrate), &mode);
    EXPECT_GE(mode.sent_bitrate(), mode.bitrate);
  }
  EXPECT_EQ(find_codec2_mode(700), nullptr);
}

TEST(SoundEncoder, RefusesSettingsOutOfRange) {
  const auto code = [](const SoundSettings& settings) {
    const auto encoder = SoundEncoder::create(settings);
    return encoder ? ErrorCode::kInternal : encoder.error().code;
  };
  for (const SoundSettings& settings :
       {SoundSettings{SoundCodec::kOpus, 0, 12000, 20}, SoundSettings{SoundCodec::kOpus, 3, 12000, 20},
        SoundSettings{SoundCodec::kOpus, 1, 5999, 20}, SoundSettings{SoundCodec::kOpus, 1, 64001, 20},
        SoundSettings{SoundCodec::kOpus, 1, 12000, 30}, SoundSettings{SoundCodec::kOpus, 1, 12000, 0},
        SoundSettings{SoundCodec::kCodec2, 2, 3200, 20}, SoundSettings{SoundCodec::kCodec2, 1, 1199, 20},
        SoundSettings{static_cast<SoundCodec>(9), 1, 12000, 20}})
    EXPECT_EQ(code(settings), ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace fbs
