#include "cli/evaluate/peers/peer_codec.h"

#include <algorithm>

#include "cli/evaluate/peers/child_process.h"

namespace fbs::cli {
namespace {

constexpr int kMinSide = 64;             // samples
constexpr int kMostOfSmall = 400 * 400;  // samples of a picture

// One group of pictures, as in a stream of fbs. Leaves out what the encoders write about themselves: at these
// rates it would be a fifth of the bytes.
const PeerCodec kX264{
    "x264",
    "x264",
    "libx264",
    "h264",
    {"-preset", "slower", "-g", "9999", "-bsf:v", "filter_units=remove_types=6", "-f", "h264"},
    {51, 46, 41, 36, 31, 26, 21}};
const PeerCodec kX265{"x265",
                      "x265",
                      "libx265",
                      "hevc",
                      {"-preset", "slow", "-x265-params", "keyint=-1:info=0:log-level=error", "-f", "hevc"},
                      {51, 46, 41, 36, 31, 26, 21}};
const PeerCodec kSvtAv1{"AV1",
                        "av1",
                        "libsvtav1",
                        "ivf",
                        {"-preset", "4", "-g", "9999", "-f", "ivf"},
                        {63, 57, 51, 45, 39, 33, 27}};
const PeerCodec kAom{"AV1",
                     "av1",
                     "libaom-av1",
                     "ivf",
                     {"-cpu-used", "3", "-b:v", "0", "-g", "9999", "-f", "ivf"},
                     {63, 57, 51, 45, 39, 33, 27}};
const PeerCodec kRealTimeAom{"AV1",
                             "av1",
                             "libaom-av1",
                             "ivf",
                             {"-usage", "realtime", "-cpu-used", "5", "-lag-in-frames", "0", "-threads", "1",
                              "-b:v", "0", "-g", "9999", "-f", "ivf"},
                             {63, 57, 51, 45, 39, 33, 27}};

}  // namespace

std::vector<PeerCodec> installed_peers(bool live) {
  const std::string list = output_of({"ffmpeg", "-v", "quiet", "-encoders"});
  const auto has = [&](const PeerCodec& codec) {
    return list.find(" " + codec.encoder + " ") != std::string::npos;
  };
  if (live) return has(kRealTimeAom) ? std::vector{kRealTimeAom} : std::vector<PeerCodec>{};
  std::vector<PeerCodec> out;
  for (const PeerCodec& codec : {kX264, kX265})
    if (has(codec)) out.push_back(codec);
  if (has(kSvtAv1))
    out.push_back(kSvtAv1);
  else if (has(kAom))
    out.push_back(kAom);
  return out;
}

std::vector<PeerVariant> peer_variants(int width, int height) {
  std::vector<PeerVariant> out;
  const int smallest = width * height > kMostOfSmall ? 4 : 2;
  for (int divisor = 1; divisor <= smallest; divisor *= 2)
    for (const int step : {1, 2, 3})
      if (divisor == 1 || std::min(width, height) / divisor >= kMinSide) out.push_back({divisor, step});
  return out;
}

std::string peer_label(const PeerCodec& codec, const PeerVariant& variant, int crf) {
  std::string out = codec.name;
  if (variant.divisor > 1) out += " 1/" + std::to_string(variant.divisor) + " size";
  if (variant.step > 1) out += " 1/" + std::to_string(variant.step) + " rate";
  return out + " crf " + std::to_string(crf);
}

}  // namespace fbs::cli
