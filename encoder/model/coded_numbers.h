// Numbers of a state in whole quantiser steps.
#pragma once

#include <span>

#include "bitstream/syntax.h"

namespace fbs {

/// The nearest state in whole steps, for the parts that are sent; the others are zero.
/// @param numbers  the first of the state, in the units of State and head units; the others are zero
[[nodiscard]] CodedState coded_state(std::span<const double> numbers, const Setup& setup);

}  // namespace fbs
