// The motion of a face through a whole stream, without its look.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/syntax.h"
#include "common/result.h"
#include "common/state.h"

namespace fbs {

struct MotionRecord {
  struct Entry {
    State state;
    std::uint32_t duration;  ///< 1/90000 s
    std::size_t geometry;    ///< index into `geometries`
  };
  Rational frame_rate;
  QuantiserSteps steps;              ///< of the first scene with a face
  PartMask parts = 0;                ///< sent by any scene
  State rest;                        ///< in which the first pattern of that scene was seen
  std::vector<Geometry> geometries;  ///< of the scenes with a face
  std::vector<Entry> pictures;       ///< the whole stream; pictures without a face hold the state before
};

/// @param stream  the whole of it
/// @return errors of StreamDecoder; kDegenerateInput when no picture shows a face
[[nodiscard]] Result<MotionRecord> read_motion_record(std::span<const std::uint8_t> stream);

}  // namespace fbs
