// Codes tracks, whole states and durations: what MotionCoder and the pattern packet share. SPEC 5.
//
// One template for all three coders (RangeEncoder, RangeDecoder, BitCounter). All memory is plain data that
// can be copied, so that an encoder may try a continuation and come back.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstdlib>

#include "bitstream/entropy/adaptive_integer.h"
#include "bitstream/entropy/mixed_bit.h"
#include "bitstream/syntax.h"

namespace fbs {

/// Magnitudes 1..kUnary are coded in unary, larger ones by Exp-Golomb from kUnary + 1 on.
inline constexpr std::size_t kUnary = 6;

/// Lengths of spans, between knots, as contexts see them: 1, 2, 3..4, 5..8, 9 and more pictures.
inline constexpr std::size_t kSpanSizes = 5;
[[nodiscard]] constexpr std::size_t span_size(std::int32_t length) {
  return length <= 2 ? static_cast<std::size_t>(length - 1) : length <= 4 ? 2 : length <= 8 ? 3 : 4;
}

/// Places in a part, as contexts see them: 0, 1, 2..3, 4..7, 8..15, 16 and more.
inline constexpr std::size_t kPlaceSizes = 6;
[[nodiscard]] constexpr std::size_t place_size(std::size_t place) {
  return place < 2 ? place : place < 4 ? 2 : place < 8 ? 3 : place < 16 ? 4 : 5;
}

/// Adaptive contexts. SPEC 5.4 names them in the same words and order. All begin at one half.
struct TrackContexts {
  template <std::size_t A, std::size_t B>
  using Grid = std::array<std::array<AdaptiveBit, B>, A>;

  // The group's header
  AdaptiveBit other_count;
  AdaptiveBit has_durations;

  // "The span reaches to the group's end"
  Grid<kPartCount, 4> to_end;
  // Its length otherwise
  std::array<ExponentialContexts, kPartCount> length;

  // "The part moves over the span"
  Grid<kPartCount, 4> moves_by_history;
  Grid<kPartCount, kSpanSizes> moves_by_span;
  Mixer<2> moves_mixer;

  // "The number changes"
  Grid<kParameterCount, 3> nonzero_by_number;
  Grid<kParameterCount, kSpanSizes> nonzero_by_span;
  Grid<kPartCount * kPlaceSizes, 9> nonzero_by_past;
  Grid<kPartCount, 36> nonzero_by_others;
  std::array<Mixer<4>, kPartCount> nonzero_mixer;

  // "The change is negative"
  Grid<kParameterCount, 3> negative_by_past;
  Grid<kPartCount, 9> negative_by_history;
  Mixer<2> negative_mixer;

  // "The magnitude is larger than k"
  Grid<kPartCount * kPlaceSizes, kUnary> larger_by_place;
  Grid<kUnary, kSpanSizes * 3> larger_by_span;
  Grid<kParameterCount, 2> larger_by_number;
  std::array<Mixer<3>, 2> larger_mixer;
  std::array<ExponentialContexts, kPartCount> rest;

  // A number coded whole: rotation, shift, scale, else
  std::array<WideIntegerContexts, 4> whole;

  // Durations
  AdaptiveBit duration_differs;
  AdaptiveBit duration_differs_from_second;
  WideIntegerContexts duration_change;
};

/// What is remembered of the knots and pictures before.
struct TrackHistory {
  CodedState change{};        ///< of each number, over the last span in which its part moved
  CodedState older_change{};  ///< over the one before that
  std::array<std::uint8_t, kPartCount> moves{};  ///< bit 0: the part moved over its last span, bit 1 ...
  std::int32_t pictures = 0;                     ///< of the last group
  std::uint32_t duration = 0;                    ///< of the picture before, 1/90000 s
  std::uint32_t older_duration = 0;              ///< of the picture before that
};

struct TrackMemory {
  TrackContexts contexts;
  TrackHistory history;
};

template <class Coder>
class TrackCoder {
 public:
  /// All are kept by reference and outlive the coder.
  TrackCoder(Coder& coder, const CodedLimits& limits, TrackMemory& memory)
      : coder_(coder), limits_(limits), contexts_(memory.contexts), history_(memory.history) {}

  /// All numbers without reference to others. SPEC 5.3.
  /// @return false when what was read lies outside the limits
  bool whole(CodedState& state);

  /// Number of pictures of the group, and whether it has durations. SPEC 4.5.
  void header(std::int32_t& pictures, bool& has_durations);

  /// How many pictures on the next knot lies, 1..left. SPEC 5.4.
  std::int32_t span(std::size_t part, std::int32_t left, bool first, std::int32_t length);

  /// The knot at the end of a span. SPEC 5.4.
  /// @param from  values at the span's begin  @param to  at its end
  /// @return false when what was read lies outside the limits
  bool knot(std::size_t part, std::int32_t length, const Knot& from, Knot& to);

  /// The duration of a picture, 1..kMaxDuration. SPEC 5.5.
  /// @return false when what was read lies outside
  bool duration(std::uint32_t& value);

 private:
  std::int32_t change(std::size_t part, std::size_t place, std::int32_t length, std::int32_t value,
                      int coded_before, bool implied);
  [[nodiscard]] static std::size_t sign_index(std::int32_t v) { return v == 0 ? 0 : v > 0 ? 1 : 2; }
  [[nodiscard]] static std::size_t size_index(std::int32_t v) {
    return static_cast<std::size_t>(std::min(std::abs(v), 2));
  }

  Coder& coder_;
  const CodedLimits& limits_;
  TrackContexts& contexts_;
  TrackHistory& history_;
  std::size_t nearby_ = 0;  // sizes of the two changes coded before in this knot, 0..2 each, the last times 3
};

template <class Coder>
bool TrackCoder<Coder>::whole(CodedState& state) {
  bool inside = true;
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    if ((limits_.parts >> kPartOf[i] & 1) == 0) {
      state[i] = 0;
      continue;
    }
    const std::size_t kind = i <= kRoll ? 0 : i <= kShiftY ? 1 : i == kLogScale ? 2 : 3;
    state[i] = code_wide_integer(coder_, contexts_.whole[kind], state[i]);
    inside = inside && state[i] >= limits_.least[i] && state[i] <= limits_.most[i];
  }
  return inside;
}

template <class Coder>
void TrackCoder<Coder>::header(std::int32_t& pictures, bool& has_durations) {
  if (coder_.bit(contexts_.other_count, pictures != history_.pictures))
    pictures = static_cast<std::int32_t>(coder_.bypass(8, static_cast<std::uint32_t>(pictures - 1))) + 1;
  else
    pictures = history_.pictures;
  static_assert(kMaxGroupPictures == 1 << 8);
  has_durations = coder_.bit(contexts_.has_durations, has_durations);
  history_.pictures = pictures;
}

template <class Coder>
std::int32_t TrackCoder<Coder>::span(std::size_t part, std::int32_t left, bool first, std::int32_t length) {
  if (left == 1) return 1;
  const std::size_t context = (first ? 2 : 0) + (history_.moves[part] & 1);
  if (coder_.bit(contexts_.to_end[part][context], length == left)) return left;
  const std::uint32_t more =
      code_exponential(coder_, contexts_.length[part], static_cast<std::uint32_t>(std::max(length, 1) - 1));
  // Beyond the end: the caller sees it.
  return static_cast<std::int32_t>(std::min<std::uint32_t>(more, kMaxGroupPictures)) + 1;
}

template <class Coder>
bool TrackCoder<Coder>::knot(std::size_t part, std::int32_t length, const Knot& from, Knot& to) {
  TrackContexts& c = contexts_;
  const auto first = kPartFirst[part];
  const auto count = kPartSizes[part];
  const bool moves = c.moves_mixer.code(
      coder_,
      {&c.moves_by_history[part][history_.moves[part] & 3], &c.moves_by_span[part][span_size(length)]},
      Coder::kReads || to.value != from.value);
  history_.moves[part] = static_cast<std::uint8_t>(history_.moves[part] << 1 | static_cast<int>(moves));
  if (!moves) {
    to.value = from.value;
    return true;
  }
  bool inside = true;
  int coded_before = 0;
  nearby_ = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const bool implied = coded_before == 0 && k + 1 == count;
    const std::int32_t delta =
        change(part, k, length, Coder::kReads ? 0 : to.value[k] - from.value[k], coded_before, implied);
    if (delta != 0) ++coded_before;
    nearby_ = nearby_ / 3 + 3 * size_index(delta);
    history_.older_change[first + k] = history_.change[first + k];
    history_.change[first + k] = delta;
    to.value[k] = from.value[k] + delta;
    inside = inside && to.value[k] >= limits_.least[first + k] && to.value[k] <= limits_.most[first + k];
  }
  return inside;
}

template <class Coder>
std::int32_t TrackCoder<Coder>::change(std::size_t part, std::size_t place, std::int32_t length,
                                       std::int32_t value, int coded_before, bool implied) {
  TrackContexts& c = contexts_;
  const std::size_t i = kPartFirst[part] + place;
  const std::size_t span = span_size(length);
  const std::size_t row = part * kPlaceSizes + place_size(place);
  const std::int32_t past = history_.change[i], older = history_.older_change[i];
  const std::size_t by_past = size_index(past) * 3 + size_index(older);

  if (!implied) {
    const auto before = static_cast<std::size_t>(std::min(coded_before, 3));
    const bool nonzero = c.nonzero_mixer[part].code(
        coder_,
        {&c.nonzero_by_number[i][size_index(past)], &c.nonzero_by_span[i][span],
         &c.nonzero_by_past[row][by_past], &c.nonzero_by_others[part][before * 9 + nearby_]},
        value != 0);
    if (!nonzero) return 0;
  }

  const bool negative =
      c.negative_mixer.code(coder_,
                            {&c.negative_by_past[i][sign_index(past)],
                             &c.negative_by_history[part][sign_index(past) * 3 + sign_index(older)]},
                            value < 0);

  const auto size = static_cast<std::uint32_t>(std::abs(value));
  std::uint32_t magnitude = 1;
  for (std::size_t k = 0; k < kUnary; ++k, ++magnitude) {
    const std::size_t from = std::min<std::size_t>(k, 1);
    const bool larger = c.larger_mixer[from].code(
        coder_,
        {&c.larger_by_place[row][k], &c.larger_by_span[k][span * 3 + size_index(past)],
         &c.larger_by_number[i][from]},
        size > magnitude);
    if (!larger) return static_cast<std::int32_t>(negative ? 0 - magnitude : magnitude);
  }
  const auto total =
      static_cast<std::int32_t>(magnitude + code_exponential(coder_, c.rest[part], size - magnitude));
  return negative ? -total : total;
}

template <class Coder>
bool TrackCoder<Coder>::duration(std::uint32_t& value) {
  TrackHistory& h = history_;
  std::uint32_t coded = h.duration;
  if (coder_.bit(contexts_.duration_differs, value != h.duration)) {
    coded = h.older_duration;
    if (coder_.bit(contexts_.duration_differs_from_second, value != h.older_duration)) {
      const auto change = static_cast<std::int32_t>(value) - static_cast<std::int32_t>(h.duration);
      const std::int64_t read = code_wide_integer(coder_, contexts_.duration_change, change);
      const std::int64_t sum = h.duration + read;
      if (sum < 1 || sum > kMaxDuration) return false;
      coded = static_cast<std::uint32_t>(sum);
    }
  }
  value = coded;
  h.older_duration = h.duration;
  h.duration = value;
  return true;
}

}  // namespace fbs
