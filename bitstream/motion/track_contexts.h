// The adaptive contexts of tracks, and the classes of lengths, places and changes that select them. SPEC 5.4.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

#include "bitstream/coded_state.h"
#include "bitstream/entropy/adaptive_integer.h"
#include "bitstream/entropy/mixer.h"
#include "bitstream/entropy/trained_contexts.h"

namespace fbs {

/// Magnitudes 1..kUnary are coded in unary, larger ones by Exp-Golomb from kUnary + 1 on.
inline constexpr std::size_t kUnary = 6;

/// Class of a span's length: 1, 2, 3..4, 5..8, 9 and more pictures.
inline constexpr std::size_t kLengthClasses = 5;
[[nodiscard]] constexpr std::size_t length_class(std::int32_t pictures) {
  return pictures <= 2 ? pictures - 1 : pictures <= 4 ? 2 : pictures <= 8 ? 3 : 4;
}

/// Class of a number's place in its part: 0, 1, 2..3, 4..7, 8..15, 16 and more.
inline constexpr std::size_t kPlaceClasses = 6;
[[nodiscard]] constexpr std::size_t place_class(std::size_t place) {
  return place < 2 ? place : place < 4 ? 2 : place < 8 ? 3 : place < 16 ? 4 : 5;
}

/// Class of a change's sign: zero, positive, negative.
inline constexpr std::size_t kSignClasses = 3;
[[nodiscard]] constexpr std::size_t sign_class(std::int32_t change) {
  return change == 0 ? 0 : change > 0 ? 1 : 2;
}

/// Class of a change's magnitude: 0, 1, 2 and more.
inline constexpr std::size_t kSizeClasses = 3;
[[nodiscard]] inline std::size_t size_class(std::int32_t change) {
  return std::min(std::abs(change), 2);
}

/// Class of the number of changes so far that are not zero: 0, 1, 2, 3 and more.
inline constexpr std::size_t kChangedClasses = 4;
[[nodiscard]] constexpr std::size_t changed_class(std::size_t changed) {
  return std::min<std::size_t>(changed, 3);
}

/// Contexts and mixers, named and ordered as in SPEC 5.4.
struct TrackContexts {
  template <std::size_t A, std::size_t B>
  using Grid = std::array<std::array<AdaptiveBit, B>, A>;

  // Whether a span reaches the end of the group, and its length otherwise
  Grid<kPartCount, 4> to_end;
  std::array<ExponentialContexts, kPartCount> length;

  // Whether a part moves over a span
  Grid<kPartCount, 4> moves_by_history;
  Grid<kPartCount, kLengthClasses> moves_by_span;
  Mixer<2> moves_mixer;

  // Whether a number changes
  Grid<kParameterCount, kSizeClasses> nonzero_by_number;
  Grid<kParameterCount, kLengthClasses> nonzero_by_span;
  Grid<kPartCount * kPlaceClasses, kSizeClasses * kSizeClasses> nonzero_by_past;
  Grid<kPartCount, kChangedClasses * kSizeClasses * kSizeClasses> nonzero_by_others;
  std::array<Mixer<4>, kPartCount> nonzero_mixer;

  // Whether a change is negative
  Grid<kParameterCount, kSignClasses> negative_by_past;
  Grid<kPartCount, kSignClasses * kSignClasses> negative_by_history;
  Mixer<2> negative_mixer;

  // Whether a magnitude is larger than k, and the rest of a magnitude beyond kUnary
  Grid<kPartCount * kPlaceClasses, kUnary> larger_by_place;
  Grid<kUnary, kLengthClasses * kSizeClasses> larger_by_span;
  Grid<kParameterCount, 2> larger_by_number;
  std::array<Mixer<3>, 2> larger_mixer;
  std::array<ExponentialContexts, kPartCount> rest;
};

/// Calls f(context) for each context, in the order of SPEC 5.4.
template <class F>
void for_each_context(TrackContexts& t, F&& f) {
  for_each_context(t.to_end, f);
  for_each_context(t.length, f);
  for_each_context(t.moves_by_history, f);
  for_each_context(t.moves_by_span, f);
  for_each_context(t.nonzero_by_number, f);
  for_each_context(t.nonzero_by_span, f);
  for_each_context(t.nonzero_by_past, f);
  for_each_context(t.nonzero_by_others, f);
  for_each_context(t.negative_by_past, f);
  for_each_context(t.negative_by_history, f);
  for_each_context(t.larger_by_place, f);
  for_each_context(t.larger_by_span, f);
  for_each_context(t.larger_by_number, f);
  for_each_context(t.rest, f);
}

}  // namespace fbs
