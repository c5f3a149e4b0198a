// Bilinear look-ups in maps of floats, four at a time. The scalar look-ups are in image/bilinear.h.
#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/core/hal/intrin.hpp>

namespace fbs {

using Four = cv::v_float32x4;  // one number for each of four points

/// A map's bilinear value at four points and its slopes, per sample of the map.
struct MapLookup {
  Four value, by_x, by_y;
};

/// Positions of four points in maps of one size.
struct MapPlace {
  std::array<std::ptrdiff_t, 4> first;  ///< index of the sample above and to the left
  std::ptrdiff_t stride;
  Four fx, fy;
  Four inside_x, inside_y;  ///< 1, or 0 where the map's border is repeated and slopes are zero

  MapPlace(const cv::Mat1f& map, const Four& x, const Four& y) : stride(map.cols) {
    const Four zero = cv::v_setzero_f32(), one = cv::v_setall_f32(1);
    const Four cx = cv::v_min(cv::v_max(x, zero), cv::v_setall_f32(static_cast<float>(map.cols) - 1.001F));
    const Four cy = cv::v_min(cv::v_max(y, zero), cv::v_setall_f32(static_cast<float>(map.rows) - 1.001F));
    const cv::v_int32x4 i = cv::v_trunc(cx), j = cv::v_trunc(cy);
    alignas(16) int column[4], row[4];
    cv::v_store_aligned(column, i);
    cv::v_store_aligned(row, j);
    for (std::size_t l = 0; l < 4; ++l) first[l] = row[l] * stride + column[l];
    fx = cx - cv::v_cvt_f32(i);
    fy = cy - cv::v_cvt_f32(j);
    inside_x = (cx == x) & one;
    inside_y = (cy == y) & one;
  }

  [[nodiscard]] MapLookup in(const cv::Mat1f& map) const {
    const float* data = map[0];
    const float *p0 = data + first[0], *p1 = data + first[1], *p2 = data + first[2], *p3 = data + first[3];
    const auto all = [&](std::ptrdiff_t k) { return Four(p0[k], p1[k], p2[k], p3[k]); };
    const Four a = all(0), along = all(1) - a, c = all(stride), along_below = all(stride + 1) - c;
    const Four above = a + along * fx, down = c + along_below * fx - above;
    return {above + down * fy, (along + (along_below - along) * fy) * inside_x, down * inside_y};
  }
};

}  // namespace fbs
