// Open bitstream units, the outermost layer of AV1.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/result.h"

namespace fbs {

/// AV1 specification 6.2.2; types not named here are reserved.
enum class ObuType : std::uint8_t {
  kSequenceHeader = 1,
  kTemporalDelimiter = 2,
  kFrameHeader = 3,  ///< without tiles: in practice one that shows an existing frame
  kTileGroup = 4,
  kMetadata = 5,
  kFrame = 6,  ///< a frame header and its tiles
  kRedundantFrameHeader = 7,
  kTileList = 8,
  kPadding = 15,
};

/// A view of one unit; valid as long as the bytes that were read.
struct Obu {
  ObuType type = ObuType::kPadding;
  bool has_extension = false;  ///< it belongs to a temporal or spatial layer
  std::span<const std::uint8_t> payload;
};

/// Splits AV1's low-overhead format (AV1 specification 5.2) into units.
class ObuReader {
 public:
  explicit ObuReader(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  [[nodiscard]] bool done() const { return left_.empty(); }

  /// The next unit, not when done(). A unit without a size field extends to the end of the bytes.
  /// @return kInvalidStream when the unit is malformed or longer than the bytes; the reader is then unusable
  Result<Obu> next();

 private:
  std::optional<std::uint8_t> byte();
  std::optional<std::uint64_t> leb128();

  std::span<const std::uint8_t> left_;
};

}  // namespace fbs
