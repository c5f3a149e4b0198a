// The codecs that fbs is compared with: which of them an installed ffmpeg has, and their options.
#pragma once

#include <string>
#include <vector>

namespace fbs::cli {

struct PeerCodec {
  std::string name;                  ///< for people: "x265", "AV1"
  std::string option;                ///< for --peer-codec: "x265", "av1"
  std::string encoder;               ///< ffmpeg's name
  std::string suffix;                ///< of a file with its raw stream
  std::vector<std::string> options;  ///< ffmpeg's, for the best that a slow preset gives at low rates
  std::vector<int> crfs;             ///< constant rate factors, from the lowest rate up
};

/// One picture size and rate at which a peer codes the source.
struct PeerVariant {
  int divisor = 1;  ///< of width and height
  int step = 1;     ///< codes one of this many pictures of the source
};

/// As far as ffmpeg has them; none without ffmpeg.
/// @param live  libaom in real time, else x264, x265 and SVT-AV1 (or libaom)
[[nodiscard]] std::vector<PeerCodec> installed_peers(bool live);

/// Full and half size, and a quarter of it for pictures of more than 400x400 samples, which at low rates are
/// often best there; each at full, half and a third of the rate. Reduced sizes only where both sides are 64
/// samples or more, the least that SVT-AV1 takes.
[[nodiscard]] std::vector<PeerVariant> peer_variants(int width, int height);

/// "x265 1/2 size 1/3 rate crf 45".
[[nodiscard]] std::string peer_label(const PeerCodec& codec, const PeerVariant& variant, int crf);

}  // namespace fbs::cli
