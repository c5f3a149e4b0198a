#include "encoder/model/coded_numbers.h"

#include <algorithm>
#include <cmath>

namespace fbs {

CodedState coded_state(std::span<const double> numbers, const Setup& setup) {
  CodedState coded{};
  const CodedLimits limits(setup.steps, setup.parts);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    coded[i] = static_cast<std::int32_t>(
        std::clamp<double>(std::round(numbers[i] / step_of(setup.steps, i)), limits.min[i], limits.max[i]));
  return coded;
}

}  // namespace fbs
