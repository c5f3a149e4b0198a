// Which patterns draw the regions of a picture, by their numbers in the stream.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "common/state.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {

/// By Region.
inline constexpr std::array<std::string_view, kRegionCount> kRegionNames = {
    "mouth", "right eye", "left eye", "face", "hair", "body", "ground"};

struct PatternWeight {
  std::size_t number = 0;   ///< of the pattern: index into the decoder's records
  bool still = false;       ///< shown unwarped
  std::int32_t weight = 0;  ///< in 1/kBlendOne
  friend bool operator==(const PatternWeight&, const PatternWeight&) = default;
};

struct PictureSources {
  std::uint64_t picture = 0;         ///< number in the stream, from 0
  std::size_t arrived = 0;           ///< patterns so far
  std::vector<std::size_t> in_slot;  ///< number of the pattern in each slot
  /// Sources of each region, by rising number, warped before still. Empty for a region the picture does not
  /// have: without a face all is ground.
  std::array<std::vector<PatternWeight>, kRegionCount> regions;
};

/// Sources of the picture that the decoder announced last.
/// @param decoder  records its patterns
[[nodiscard]] PictureSources picture_sources(const StreamDecoder& decoder);
/// The same for another state in its place.
[[nodiscard]] PictureSources picture_sources(const StreamDecoder& decoder, const State& state);

}  // namespace fbs::cli
