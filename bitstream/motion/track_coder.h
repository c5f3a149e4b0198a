// Codes spans and knots of tracks. SPEC 5.4.
//
// One template for RangeEncoder, RangeDecoder and BitCounter. All memory is plain data that can be copied, so
// that an encoder can try a group and go back.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "bitstream/motion/track_contexts.h"
#include "bitstream/syntax.h"

namespace fbs {

/// Memory of the spans before.
struct TrackHistory {
  CodedState change{};        ///< of each number, over the last span in which its part moved
  CodedState older_change{};  ///< over the span before, in which its part also moved
  std::array<std::uint8_t, kPartCount> moves{};  ///< bit k: the part moved k + 1 spans ago
};

template <class Coder>
class TrackCoder {
 public:
  /// All arguments are kept by reference and outlive the coder.
  TrackCoder(Coder& coder, const CodedLimits& limits, TrackContexts& contexts, TrackHistory& history)
      : coder_(coder), limits_(limits), contexts_(contexts), history_(history) {}

  /// The length of a span in pictures.
  /// @param left   pictures up to the end of the group; a reader may return more, which is invalid
  /// @param first  the span is the part's first in the group
  std::int32_t span(std::size_t part, std::int32_t left, bool first, std::int32_t length);

  /// The knot at the end of a span.
  /// @param from  the knot at the start of the span
  /// @param to    the knot at its end; its numbers are set by a Coder that reads
  /// @return false when what was read is out of range
  bool knot(std::size_t part, std::int32_t length, const Knot& from, Knot& to);

 private:
  /// One number of a knot, and what selects its contexts.
  struct Number {
    std::size_t part, index;             // index: 0..kParameterCount - 1
    std::size_t row;                     // by part and place in the part
    std::size_t length;                  // class of the span's length
    std::int32_t past, older;            // its last two changes
    std::size_t changed;                 // numbers of this knot before it that change
    std::size_t last_size, second_size;  // size classes of the two changes before in this knot
  };
  std::int32_t change(const Number& number, bool implied, std::int32_t value);
  bool nonzero(const Number& number, bool value);
  bool negative(const Number& number, bool value);
  std::uint32_t magnitude(const Number& number, std::uint32_t value);

  Coder& coder_;
  const CodedLimits& limits_;
  TrackContexts& contexts_;
  TrackHistory& history_;
};

template <class Coder>
std::int32_t TrackCoder<Coder>::span(std::size_t part, std::int32_t left, bool first, std::int32_t length) {
  if (left == 1) return 1;
  const std::size_t context = (first ? 2 : 0) + (history_.moves[part] & 1);
  if (coder_.bit(contexts_.to_end[part][context], length == left)) return left;
  const std::uint32_t more =
      code_exponential(coder_, contexts_.length[part], static_cast<std::uint32_t>(std::max(length, 1) - 1));
  return static_cast<std::int32_t>(std::min<std::uint32_t>(more, kMaxGroupPictures)) + 1;
}

template <class Coder>
bool TrackCoder<Coder>::knot(std::size_t part, std::int32_t length, const Knot& from, Knot& to) {
  const std::size_t first = kPartFirst[part], count = kPartSizes[part], span = length_class(length);
  std::uint8_t& history = history_.moves[part];
  const bool moves = contexts_.moves_mixer.code(
      coder_, {&contexts_.moves_by_history[part][history & 3], &contexts_.moves_by_span[part][span]},
      Coder::kReads || to.value != from.value);
  history = static_cast<std::uint8_t>(history << 1 | static_cast<int>(moves));
  if (!moves) {
    to.value = from.value;
    return true;
  }
  bool in_range = true;
  std::size_t changed = 0, last_size = 0, second_size = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = first + k;
    std::int32_t &past = history_.change[i], &older = history_.older_change[i];
    const Number number = {
        part, i, part * kPlaceClasses + place_class(k), span, past, older, changed, last_size, second_size};
    const bool implied = changed == 0 && k + 1 == count;
    const std::int32_t delta = change(number, implied, Coder::kReads ? 0 : to.value[k] - from.value[k]);
    if (delta != 0) ++changed;
    second_size = last_size;
    last_size = size_class(delta);
    older = past;
    past = delta;
    to.value[k] = from.value[k] + delta;
    in_range = in_range && limits_.hold(i, to.value[k]);
  }
  return in_range;
}

template <class Coder>
std::int32_t TrackCoder<Coder>::change(const Number& n, bool implied, std::int32_t value) {
  if (!implied && !nonzero(n, value != 0)) return 0;
  const bool below = negative(n, value < 0);
  const auto size = static_cast<std::int32_t>(magnitude(n, static_cast<std::uint32_t>(std::abs(value))));
  return below ? -size : size;
}

template <class Coder>
bool TrackCoder<Coder>::nonzero(const Number& n, bool value) {
  TrackContexts& c = contexts_;
  const std::size_t past = size_class(n.past), older = size_class(n.older);
  const std::size_t others = (changed_class(n.changed) * kSizeClasses + n.last_size) * kSizeClasses;
  return c.nonzero_mixer[n.part].code(
      coder_,
      {&c.nonzero_by_number[n.index][past], &c.nonzero_by_span[n.index][n.length],
       &c.nonzero_by_past[n.row][past * kSizeClasses + older],
       &c.nonzero_by_others[n.part][others + n.second_size]},
      value);
}

template <class Coder>
bool TrackCoder<Coder>::negative(const Number& n, bool value) {
  TrackContexts& c = contexts_;
  const std::size_t past = sign_class(n.past), older = sign_class(n.older);
  return c.negative_mixer.code(
      coder_,
      {&c.negative_by_past[n.index][past], &c.negative_by_history[n.part][past * kSignClasses + older]},
      value);
}

template <class Coder>
std::uint32_t TrackCoder<Coder>::magnitude(const Number& n, std::uint32_t value) {
  TrackContexts& c = contexts_;
  const std::size_t by_span = n.length * kSizeClasses + size_class(n.past);
  std::uint32_t size = 1;
  for (std::size_t k = 0; k < kUnary; ++k, ++size) {
    const std::size_t beyond_one = std::min<std::size_t>(k, 1);
    const bool larger =
        c.larger_mixer[beyond_one].code(coder_,
                                        {&c.larger_by_place[n.row][k], &c.larger_by_span[k][by_span],
                                         &c.larger_by_number[n.index][beyond_one]},
                                        value > size);
    if (!larger) return size;
  }
  return size + code_exponential(coder_, c.rest[n.part], value - size);
}

}  // namespace fbs
