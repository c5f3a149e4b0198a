// Copies the sound of a source into our output. Part of the module fbs_av.
#pragma once

#include <cstdint>
#include <string>

#include "cli/video/av/av_muxer.h"
#include "cli/video/av/av_support.h"

namespace fbs {

/// Copies packets without re-encoding. Times count from the first picture of the source, which is time 0 of a
/// stream made from it; without pictures, from its start.
class AvSound {
 public:
  /// Finds the main sound stream of `source` and adds one for it to the muxer.
  /// @param begin  1/90000 s: time in the source that is 0 in the output
  /// @return ErrorCode::kUnsupported when there is no sound or the container cannot hold it
  static Result<AvSound> open(const std::string& source, std::int64_t begin, AvMuxer& muxer);

  /// Writes all packets that begin before `end`.
  /// @param end  1/90000 s
  Result<void> copy_until(std::int64_t end, AvMuxer& muxer);

 private:
  AvSound() = default;
  /// Reads the next packet of sound into packet_. @return false at the end
  Result<bool> read();

  std::string name_;
  AvInput container_;
  AvPacket packet_;
  AVStream* from_ = nullptr;   ///< of container_
  AVStream* to_ = nullptr;     ///< of the muxer
  std::int64_t shift_ = 0;     ///< subtracted from times of the source, in from_'s time base
  bool begins_later_ = false;  ///< sound before time 0 of the output is left out
  bool waiting_ = false;       ///< packet_ has been read but not yet written
  bool ended_ = false;
};

}  // namespace fbs
