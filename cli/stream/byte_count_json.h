// Bytes of a stream as JSON, for `inspect` and `evaluate`.
#pragma once

#include <nlohmann/json.hpp>

#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {

inline nlohmann::json byte_count_json(const ByteCount& bytes) {
  return {{"total", bytes.total},
          {"startup", bytes.startup},
          {"geometry", bytes.geometry},
          {"patterns", bytes.patterns},
          {"motion", bytes.motion},
          {"sound", bytes.sound},
          {"index", 0},  // format 3 has no index packet; readers of this JSON add the key up
          {"other", bytes.other}};
}

}  // namespace fbs::cli
