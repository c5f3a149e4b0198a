// The pictures that a viewer of a stream sees, for fbs or another codec.
#pragma once

#include <memory>
#include <string>

#include "cli/files/stop_signal.h"
#include "common/picture.h"
#include "common/result.h"

namespace fbs::cli {

class ShownPictures {
 public:
  virtual ~ShownPictures() = default;

  /// The next picture, valid until the next call; null at the end. Errors name the stream.
  virtual Result<const Picture*> next() = 0;
};

/// @param stop  must outlive the object; may be null
Result<std::unique_ptr<ShownPictures>> open_fbs_pictures(const std::string& stream, const StopSignal* stop);

/// Pictures of another codec's stream, decoded by ffmpeg, at the size and rate of the source.
struct PeerStream {
  std::string file;
  int width = 0, height = 0;   ///< of the source: pictures are scaled to it, bicubic
  int step = 1;                ///< codes one of this many pictures of the source, and shows it as often
  std::uint64_t pictures = 0;  ///< of the source
};

Result<std::unique_ptr<ShownPictures>> open_peer_pictures(const PeerStream& stream);

}  // namespace fbs::cli
