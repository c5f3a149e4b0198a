// Consecutive pictures of a scene whose patterns are chosen and coded together.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "bitstream/syntax.h"
#include "common/state.h"
#include "encoder/picture_spool.h"

namespace fbs {

/// A packet to be written.
using TypedPayload = std::pair<PacketType, std::vector<std::uint8_t>>;

struct Segment {
  /// A motion packet, and how many pictures it moves.
  struct Group {
    std::size_t pictures;
    std::vector<std::uint8_t> payload;
  };
  PictureSpool pictures;
  std::vector<Group> groups;
  std::vector<State> states;  ///< of each picture, as coded

  /// Gives a picture another state; its number and its blend modes stay.
  void move(std::size_t picture, const State& to);
};

/// Indices of the patterns that a decoder has when it draws the pictures of a group.
using AvailablePatterns = std::vector<std::size_t>;

/// Of each group, how many of the segment's patterns are sent before its pictures are drawn: all up to the
/// first that shows its last picture or one behind it.
/// @param shown        picture of each pattern in coding order, counted from the segment's first
/// @param first_alone  whether the first of several groups is drawn from the first pattern alone, so that a
///                     viewer need not wait for more
[[nodiscard]] std::vector<std::size_t> arrivals(const Segment& segment, std::span<const std::size_t> shown,
                                                bool first_alone);

/// The packets of a segment in stream order: before each pattern the motion that gives its state, before each
/// blend all that it is drawn from.
/// @param patterns  payloads in coding order
/// @param blends    payload for each group
[[nodiscard]] std::vector<TypedPayload> in_stream_order(Segment segment, std::span<const std::size_t> shown,
                                                        std::span<const std::size_t> arrived,
                                                        std::vector<std::vector<std::uint8_t>> patterns,
                                                        std::vector<std::vector<std::uint8_t>> blends);

}  // namespace fbs
