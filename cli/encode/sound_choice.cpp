#include "cli/encode/sound_choice.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace fbs::cli {
namespace {

/// kbit/s of a codec.
struct Rates {
  double least, usual, most;  ///< `usual` is the most that is chosen
};
constexpr Rates kOpus{6, 16, 64}, kCodec2{1.2, 3.2, 3.2};
constexpr double kShareOfTotal = 0.3;  ///< of --bitrate, for the sound
/// Least --bitrate for Opus, kbit/s: with less it would leave the pictures below the 4 kbit/s they need.
constexpr double kLeastTotalOfOpus = 10;

constexpr int kLiveFrame = 20, kFileFrame = 60;  // ms
constexpr double kPacketBits = 8 * 8,
                 kSizeBits = 8;  // of a packet's header, and of the size of a frame of Opus

SoundCodec chosen_codec(const EncodeArguments& a) {
  if (a.sound) return *a.sound == "codec2" ? SoundCodec::kCodec2 : SoundCodec::kOpus;
  const bool low = a.sound_bitrate ? *a.sound_bitrate < kOpus.least
                                   : a.settings.bitrate > 0 && a.settings.bitrate < kLeastTotalOfOpus;
  return low ? SoundCodec::kCodec2 : SoundCodec::kOpus;
}

/// Grows with the square of the quality: up to the middle the sound takes little more than the least, like
/// pictures.
double chosen_rate(const EncodeArguments& a, const Rates& rates) {
  const double share = a.settings.quality / 100.0;
  const double wanted = a.settings.bitrate > 0 ? kShareOfTotal * a.settings.bitrate
                                               : rates.least + (rates.usual - rates.least) * share * share;
  return std::clamp(wanted, rates.least, rates.usual);
}

}  // namespace

Result<SoundSettings> sound_settings(const EncodeArguments& a, bool live) {
  SoundSettings settings;
  settings.codec = chosen_codec(a);
  const Rates& rates = settings.codec == SoundCodec::kOpus ? kOpus : kCodec2;
  const double rate = a.sound_bitrate.value_or(chosen_rate(a, rates));
  if (rate < rates.least || rate > rates.most)
    return fail(ErrorCode::kInvalidArgument, settings.codec == SoundCodec::kOpus
                                                 ? "--sound-bitrate of opus is from 6 to 64 kbit/s"
                                                 : "--sound-bitrate of codec2 is from 1.2 to 3.2 kbit/s");
  settings.bitrate = static_cast<int>(std::lround(1000 * rate));
  settings.frame_ms = live ? kLiveFrame : kFileFrame;
  return settings;
}

double sound_kbps(const SoundSettings& settings) {
  const double frames = settings.codec == SoundCodec::kOpus ? 1000.0 / settings.frame_ms : 0;  // with a size
  return (settings.bitrate + frames * kSizeBits + kPacketBits) / 1000;
}

}  // namespace fbs::cli
