// Consecutive pictures of a scene whose patterns are chosen and coded together.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bitstream/syntax.h"
#include "common/state.h"
#include "encoder/plan/pattern_times.h"
#include "encoder/segment/picture_spool.h"

namespace fbs {

/// Number of patterns that a decoder keeps: as many as fit in little memory.
[[nodiscard]] std::int32_t pattern_store(const VideoFormat& format);

/// A packet to be written.
using TypedPayload = std::pair<PacketType, std::vector<std::uint8_t>>;

struct Segment {
  /// A motion packet and its number of pictures.
  struct Group {
    std::size_t pictures;
    std::vector<std::uint8_t> payload;
  };
  PictureSpool pictures;
  std::vector<Group> groups;
  std::vector<State> states;  ///< of each picture, as coded
  std::vector<Shot> shots;    ///< that its pictures fall into; the first may have begun before

  /// Whether a picture begins another shot.
  [[nodiscard]] bool is_cut(std::size_t picture) const;
  /// Gives a picture another state; its number and its blend modes stay.
  void move(std::size_t picture, const State& to);
};

/// Indices of the patterns that a decoder has when it draws the pictures of a group.
using AvailablePatterns = std::vector<std::size_t>;

/// For each group, how many of the segment's patterns are sent before its pictures are drawn: all up to the
/// first that shows its last picture or a later one.
/// @param shown        picture of each pattern in coding order, counted from the segment's first
/// @param first_alone  whether the first of several groups uses the first pattern alone, so that a viewer
/// need not wait for more
[[nodiscard]] std::vector<std::size_t> arrivals(const Segment& segment, std::span<const std::size_t> shown,
                                                bool first_alone);

/// A packet of a segment, still to be coded.
struct PlannedPacket {
  PacketType type;    ///< kMotion, kPattern or kBlend
  std::size_t first;  ///< group, or of several patterns the first in coding order
  std::size_t count;  ///< patterns; otherwise 1
};

/// The packets of a segment in stream order: before each pattern the motion that gives its state, before each
/// blend all its patterns. Patterns not separated by a blend share a packet, except the scene's first.
/// @param bytes  of each pattern
[[nodiscard]] std::vector<PlannedPacket> in_stream_order(const Segment& segment,
                                                         std::span<const std::size_t> shown,
                                                         std::span<const std::size_t> arrived,
                                                         std::span<const std::size_t> bytes);

}  // namespace fbs
