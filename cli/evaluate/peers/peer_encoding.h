// Codes a source with another codec through ffmpeg.
#pragma once

#include <cstdint>
#include <string>

#include "cli/evaluate/peers/peer_codec.h"
#include "cli/files/stop_signal.h"
#include "cli/source/source_part.h"
#include "common/result.h"

namespace fbs::cli {

struct PeerJob {
  PeerCodec codec;
  PeerVariant variant;
  int crf = 0;
  std::string file;    ///< of the raw stream
  bool quiet = false;  ///< no progress bar
};

/// Codes the source up to its limits. The file appears when complete; an incomplete one is removed.
/// @param stop  may be null
/// @return kIo with what ffmpeg said, or when the signal came
Result<void> encode_peer(const std::string& source, const PartLimits& limits, const PeerJob& job,
                         const StopSignal* stop);

/// Bytes of the packets in a raw stream. For .ivf without its headers and the temporal delimiters of AV1, two
/// bytes per picture that no container needs; otherwise the size of the file.
/// @return kIo; kInvalidStream for a damaged .ivf
Result<std::uint64_t> packet_bytes(const std::string& file);

}  // namespace fbs::cli
