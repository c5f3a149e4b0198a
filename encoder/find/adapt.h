// Adapts the generic head to the marked face. Paper section 2.1, Fig. 3 (c), (d).
#pragma once

#include "bitstream/syntax.h"
#include "common/result.h"
#include "encoder/find/marks.h"
#include "encoder/model/pose.h"

namespace fbs {

struct AdaptedHead {
  Geometry geometry;   ///< head units
  Pose pose;           ///< in the marked picture: no pitch; yaw as estimated from the marks
  int iterations = 0;  ///< of the elastic process until it came to rest
};

/// Rotates and scales the generic head to the marks (similarity from the eyes; then width and yaw together,
/// since yaw moves deep points sideways; then height), then deforms it elastically (fit_elastically). Depth
/// is scaled by the mean of width and height and not deformed. The paper marks a frontal picture; here the
/// face may be turned.
/// @return kDegenerateInput when an eye has no mark, or a coordinate is not a number or beyond kMaxMarkPx
[[nodiscard]] Result<AdaptedHead> adapt_head(const Marks& marks);

}  // namespace fbs
