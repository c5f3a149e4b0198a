// A loop that uses every core.
#pragma once

#include <cstddef>
#include <opencv2/core/utility.hpp>

namespace fbs {

/// each(0) .. each(count - 1), in any order.
template <class Each>
void in_parallel(std::size_t count, Each each) {
  cv::parallel_for_(cv::Range(0, static_cast<int>(count)), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) each(static_cast<std::size_t>(i));
  });
}

}  // namespace fbs
