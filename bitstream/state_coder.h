// Codes states one after another: what MotionCoder, MotionCounter and the pattern packet share. SPEC 5.
//
// One template for all three coders (RangeEncoder, RangeDecoder, BitCounter). All memory is plain data that
// can be copied, so that an encoder may try a continuation and come back.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstdlib>

#include "bitstream/adaptive_integer.h"
#include "bitstream/mixed_bit.h"
#include "bitstream/state_layout.h"

namespace fbs {

/// Bit p: part p is predicted by its damped velocity (the last value plus half of its last change, rounded
/// toward zero); otherwise by its last value.
using PredictionChoice = PartMask;

/// Magnitudes 1..kUnary are coded in unary, larger ones by Exp-Golomb from kUnary + 1 on.
inline constexpr std::size_t kUnary = 6;

/// Adaptive contexts of states. All begin at one half: expectations written into the format were tried and
/// won nothing, since a context comes near the truth within two or three bits. SPEC 5.4 names them in the
/// same words and order.
struct StateContexts {
  template <std::size_t A, std::size_t B>
  using Grid = std::array<std::array<AdaptiveBit, B>, A>;

  // Choice of the prediction, once a group
  AdaptiveBit any_damped;
  std::array<AdaptiveBit, kPartCount> damped;

  // "The picture differs from the one before"
  std::array<AdaptiveBit, 16> moves_by_history;
  std::array<AdaptiveBit, 4> moves_by_size;
  Mixer<2> moves_mixer;

  // "The part has a residual"
  Grid<kPartCount, 8> part_by_history;
  Grid<kPartCount, 12> part_by_others;
  std::array<AdaptiveBit, 24> part_by_size;
  Mixer<3> part_mixer;

  // "The residual of the parameter is not zero"
  Grid<kClassCount, 9> nonzero_by_past;
  Grid<kKindCount, 81> nonzero_by_neighbours;
  Grid<kParameterCount, 4> nonzero_by_place;
  std::array<Mixer<3>, kKindCount> nonzero_mixer;

  // "The residual is negative"
  Grid<kClassCount, 9> negative_by_past;
  Grid<kKindCount, 27> negative_by_neighbours;
  Grid<kParameterCount, 3> negative_by_place;
  std::array<Mixer<3>, kKindCount> negative_mixer;

  // "The magnitude is larger than k"
  Grid<kClassCount, kUnary> larger_by_class;
  Grid<kUnary, 9> larger_by_activity;
  Grid<kParameterCount, 2> larger_by_place;
  std::array<Mixer<3>, 2> larger_mixer;
  std::array<ExponentialContexts, kKindCount> rest;

  // A number coded whole: rotation, shift, scale, control x, control y
  std::array<WideIntegerContexts, 5> whole;

  // Durations
  AdaptiveBit duration_differs;
  AdaptiveBit duration_differs_from_second;
  WideIntegerContexts duration_change;
};

/// What is remembered of the pictures before.
struct StateHistory {
  FlatState last{};            ///< state of the picture before
  FlatState change{};          ///< last minus the state before it; zero after a state coded whole
  FlatState residual{};        ///< of the picture before
  FlatState older_residual{};  ///< of the picture before that
  std::array<std::int8_t, kParameterCount>
      last_sign{};  ///< of the last residual that was not zero; 0: none yet
  std::array<std::uint8_t, kPartCount>
      part_history{};                ///< bit 0: had a residual in the picture before, bit 1 ...
  std::uint8_t moves_history = 0;    ///< the same for "the picture differs"
  std::uint8_t parts_before = 0;     ///< parts with a residual in the last picture that moved
  std::uint32_t duration = 0;        ///< of the picture before, 1/90000 s
  std::uint32_t older_duration = 0;  ///< of the picture before that
};

struct MotionMemory {
  StateContexts contexts;
  StateHistory history;
};

template <class Coder>
class StateCoder {
 public:
  /// All are kept by reference and outlive the coder.
  StateCoder(Coder& coder, const StateLimits& limits, MotionMemory& memory)
      : coder_(coder), limits_(limits), contexts_(memory.contexts), history_(memory.history) {}

  /// The prediction of each part for the pictures to come. SPEC 5.2.
  PredictionChoice choice(PredictionChoice damped) {
    if (!coder_.bit(contexts_.any_damped, damped != 0)) return 0;
    PredictionChoice read = 0;
    for (std::size_t part = 0; part < kPartCount; ++part) {
      if ((limits_.coded >> part & 1) == 0) continue;
      const bool on = coder_.bit(contexts_.damped[part], (damped >> part & 1) != 0);
      read = static_cast<PredictionChoice>(read | static_cast<int>(on) << part);
    }
    return read;
  }

  /// A state without reference to others. SPEC 5.3.
  /// @return false when what was read lies outside the limits
  bool whole(FlatState& state);

  /// A state after the one before. SPEC 5.4.
  /// @return false when what was read lies outside the limits
  bool next(FlatState& state, PredictionChoice damped);

  /// The duration of a picture, 1..kMaxDuration. SPEC 5.5.
  /// @return false when what was read lies outside
  bool duration(std::uint32_t& value);

 private:
  [[nodiscard]] std::int32_t predicted(std::size_t i, PredictionChoice damped) const {
    if ((damped >> parameters()[i].part & 1) == 0) return history_.last[i];
    return std::clamp(history_.last[i] + history_.change[i] / 2, limits_.least[i], limits_.most[i]);
  }
  bool part_flag(std::size_t part, bool value, PartMask with_residual);
  void part_residuals(std::size_t part);
  std::int32_t residual(std::size_t i, std::int32_t value, int coded_before, bool implied);

  // Magnitude, up to `most`, and sign of a neighbour's residual in the picture that is being coded.
  [[nodiscard]] int size_of(const Neighbour& n, int most) const {
    return n.parameter < 0 ? 0 : std::min(std::abs(residuals_[static_cast<std::size_t>(n.parameter)]), most);
  }
  [[nodiscard]] std::size_t sign_of(const Neighbour& n) const {
    return n.parameter < 0 ? 0 : sign_index(n.sign * residuals_[static_cast<std::size_t>(n.parameter)]);
  }
  static std::size_t sign_index(std::int32_t value) { return value == 0 ? 0 : value > 0 ? 1 : 2; }

  Coder& coder_;
  const StateLimits& limits_;
  StateContexts& contexts_;
  StateHistory& history_;
  FlatState residuals_{};  // of the picture that is being coded
};

template <class Coder>
bool StateCoder<Coder>::whole(FlatState& state) {
  bool inside = true;
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    if ((limits_.coded >> parameters()[i].part & 1) == 0) {
      state[i] = 0;
      continue;
    }
    const std::size_t kind = i <= kRoll ? 0 : i <= kShiftY ? 1 : i == kLogScale ? 2 : i % 2 == 0 ? 3 : 4;
    state[i] = code_wide_integer(coder_, contexts_.whole[kind], state[i]);
    inside = inside && state[i] >= limits_.least[i] && state[i] <= limits_.most[i];
  }
  const std::uint32_t duration = history_.duration;
  const std::uint32_t older_duration = history_.older_duration;
  history_ = StateHistory{};
  history_.last = state;
  history_.duration = duration;
  history_.older_duration = older_duration;
  return inside;
}

template <class Coder>
bool StateCoder<Coder>::next(FlatState& state, PredictionChoice damped) {
  StateContexts& c = contexts_;
  const bool moves = c.moves_mixer.code(coder_,
                                        {&c.moves_by_history[history_.moves_history & 15],
                                         &c.moves_by_size[std::min<std::size_t>(history_.parts_before, 3)]},
                                        Coder::kReads || state != history_.last);
  history_.moves_history = static_cast<std::uint8_t>(history_.moves_history << 1 | static_cast<int>(moves));

  residuals_ = FlatState{};
  PartMask with_residual = 0;
  bool inside = true;
  if (moves) {
    for (std::size_t part = 0; part < kPartCount; ++part) {
      if ((limits_.coded >> part & 1) == 0) continue;
      const auto first = static_cast<std::size_t>(parts()[part].first);
      const auto end = first + static_cast<std::size_t>(parts()[part].count);
      bool any = false;
      if constexpr (!Coder::kReads) {
        for (std::size_t i = first; i < end; ++i) {
          residuals_[i] = state[i] - predicted(i, damped);
          any = any || residuals_[i] != 0;
        }
      }
      if (part_flag(part, any, with_residual)) {
        with_residual = static_cast<PartMask>(with_residual | 1 << part);
        part_residuals(part);
      }
      for (std::size_t i = first; i < end; ++i) {
        state[i] = predicted(i, damped) + residuals_[i];
        inside = inside && state[i] >= limits_.least[i] && state[i] <= limits_.most[i];
      }
    }
    history_.parts_before = static_cast<std::uint8_t>(std::popcount(with_residual));
  } else {
    state = history_.last;
  }

  for (std::size_t part = 0; part < kPartCount; ++part) {
    history_.part_history[part] =
        static_cast<std::uint8_t>((history_.part_history[part] << 1 | (with_residual >> part & 1)) & 7);
  }
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    history_.change[i] = state[i] - history_.last[i];
    if (residuals_[i] != 0) history_.last_sign[i] = residuals_[i] > 0 ? 1 : 2;
  }
  history_.last = state;
  history_.older_residual = history_.residual;
  history_.residual = residuals_;
  return inside;
}

template <class Coder>
bool StateCoder<Coder>::part_flag(std::size_t part, bool value, PartMask with_residual) {
  StateContexts& c = contexts_;
  const std::size_t past = history_.part_history[part];
  const int partner = parts()[part].partner;
  const std::size_t together = partner < 0 ? 2 : with_residual >> partner & 1;
  const std::size_t pose = part == 0 ? 0 : with_residual & 1;
  const std::size_t size = std::min<std::size_t>(history_.parts_before, 5);
  const std::size_t others = std::min<std::size_t>(static_cast<std::size_t>(std::popcount(with_residual)), 3);
  return c.part_mixer.code(
      coder_,
      {&c.part_by_history[part][past], &c.part_by_others[part][together * 4 + pose * 2 + (past & 1)],
       &c.part_by_size[size * 4 + others]},
      value);
}

template <class Coder>
void StateCoder<Coder>::part_residuals(std::size_t part) {
  const auto first = static_cast<std::size_t>(parts()[part].first);
  const auto count = static_cast<std::size_t>(parts()[part].count);
  int coded_before = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    const bool implied = coded_before == 0 && i + 1 == first + count;
    residuals_[i] = residual(i, residuals_[i], coded_before, implied);
    if (residuals_[i] != 0) ++coded_before;
  }
}

template <class Coder>
std::int32_t StateCoder<Coder>::residual(std::size_t i, std::int32_t value, int coded_before, bool implied) {
  StateContexts& c = contexts_;
  const Parameter& p = parameters()[i];
  const auto kind = static_cast<std::size_t>(p.kind);
  const auto of_class = static_cast<std::size_t>(p.of_class);
  const int past = std::abs(history_.residual[i]);
  const int older = std::abs(history_.older_residual[i]);

  if (!implied) {
    const auto by_past = static_cast<std::size_t>(std::min(past, 2) * 3 + std::min(older, 2));
    const auto by_neighbours = static_cast<std::size_t>(
        ((size_of(p.previous, 2) * 3 + size_of(p.across, 2)) * 3 + size_of(p.partner, 2)) * 3 +
        std::min(past, 2));
    const bool nonzero = c.nonzero_mixer[kind].code(
        coder_,
        {&c.nonzero_by_past[of_class][by_past], &c.nonzero_by_neighbours[kind][by_neighbours],
         &c.nonzero_by_place[i][static_cast<std::size_t>(std::min(coded_before, 3))]},
        value != 0);
    if (!nonzero) return 0;
  }

  const std::size_t past_sign = sign_index(history_.residual[i]);
  const bool negative = c.negative_mixer[kind].code(
      coder_,
      {&c.negative_by_past[of_class][past_sign * 3 + sign_index(history_.older_residual[i])],
       &c.negative_by_neighbours[kind]
                                [(sign_of(p.previous) * 3 + sign_of(p.across)) * 3 + sign_of(p.partner)],
       &c.negative_by_place[i][static_cast<std::size_t>(history_.last_sign[i])]},
      value < 0);

  const auto size = static_cast<std::uint32_t>(std::abs(value));
  const int activity =
      std::min(std::min(past, 3) + size_of(p.previous, 3) + size_of(p.across, 3) + size_of(p.partner, 3), 8);
  std::uint32_t magnitude = 1;
  for (std::size_t k = 0; k < kUnary; ++k, ++magnitude) {
    const std::size_t first = std::min<std::size_t>(k, 1);
    const bool larger = c.larger_mixer[first].code(
        coder_,
        {&c.larger_by_class[of_class][k], &c.larger_by_activity[k][static_cast<std::size_t>(activity)],
         &c.larger_by_place[i][first]},
        size > magnitude);
    if (!larger) return static_cast<std::int32_t>(negative ? 0 - magnitude : magnitude);
  }
  const auto total =
      static_cast<std::int32_t>(magnitude + code_exponential(coder_, c.rest[kind], size - magnitude));
  return negative ? -total : total;
}

template <class Coder>
bool StateCoder<Coder>::duration(std::uint32_t& value) {
  StateHistory& h = history_;
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
