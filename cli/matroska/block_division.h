// Divides the packets of a stream into blocks of Matroska.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs::cli {

/// Packets that are read together: those that release some pictures, and those they need.
struct StreamBlock {
  std::uint64_t time = 0, duration = 0;  ///< of its pictures, 1/90000 s
  bool key = false;                      ///< begins with a setup packet where the stream can be joined
  std::size_t begin = 0, end = 0;        ///< bytes of the stream
};

struct StreamBlocks {
  std::vector<StreamBlock> blocks;  ///< all bytes after the signature are in one of them
  Setup setup;                      ///< the first one
  std::size_t setup_begin = 0, setup_end = 0;
  bool constant_rate = true;  ///< all pictures have the nominal duration of `setup`
};

/// @return kNotFbs; kTruncated without a setup packet; errors of decode_setup() for the first one
Result<StreamBlocks> divide_stream(std::span<const std::uint8_t> stream);

}  // namespace fbs::cli
