// Inputs of the fuzz targets, taken out of streams.
#pragma once

#include "bitstream/syntax.h"
#include "tests/fuzz/fuzz_target.h"

namespace fbs::fuzz {

/// Payloads of the packets of one type, up to the first damaged packet.
std::vector<Bytes> payloads_of(const Bytes& stream, PacketType type);

/// The AV1 frames of one scene, in the order of decoding.
struct SceneFrames {
  int width = 0, height = 0;  ///< pixels, of the setup
  std::vector<Bytes> frames;
};

/// The frames of each scene that has any, up to the first packet that is damaged or invalid.
std::vector<SceneFrames> frames_of(const Bytes& stream);

}  // namespace fbs::fuzz
