// What contexts know before a scene begins: how often their bits were zero in other videos. SPEC 5.6.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "bitstream/entropy/adaptive_bit.h"
#include "bitstream/entropy/adaptive_integer.h"

namespace fbs {

/// A context's probability of a zero in 1/256 and, for how many bits it counts.
struct TrainedContext {
  std::uint8_t zero = 128, bits = 0;
};

/// Calls f(AdaptiveBit&) for each context of nested arrays, in their order.
template <class F>
void for_each_context(AdaptiveBit& context, F&& f) {
  f(context);
}
template <class F>
void for_each_context(ExponentialContexts& contexts, F&& f) {
  for (AdaptiveBit& c : contexts.more) f(c);
  for (AdaptiveBit& c : contexts.top_bit) f(c);
}
template <class T, std::size_t N, class F>
void for_each_context(std::array<T, N>& contexts, F&& f) {
  for (T& c : contexts) for_each_context(c, f);
}

/// A memory whose contexts have their state from a table, in the order of for_each_context(memory, f).
/// @param table  an entry for each
template <class Memory>
Memory trained(std::span<const TrainedContext> table) {
  Memory memory;
  std::size_t k = 0;
  for_each_context(memory, [&](AdaptiveBit& context) {
    context = AdaptiveBit(static_cast<std::uint16_t>(table[k].zero << 8), table[k].bits);
    ++k;
  });
  assert(k == table.size());
  return memory;
}

/// The tables of motion and of blends, learned by training/train_contexts.cpp.
[[nodiscard]] std::span<const TrainedContext> trained_motion();
[[nodiscard]] std::span<const TrainedContext> trained_blends();

}  // namespace fbs
