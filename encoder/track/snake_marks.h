// Marks of the first picture, corrected by the snakes.
#pragma once

#include "common/picture.h"
#include "common/result.h"
#include "encoder/find/adapt.h"

namespace fbs {

/// Adapts the head to the marks, lets the snakes come to rest on the picture, moves the marks of lips and
/// lids to where the curves are, and adapts the head again. A curve that has strayed changes nothing.
/// @return as adapt_head()
[[nodiscard]] Result<AdaptedHead> adapt_with_snakes(const Picture& picture, Marks marks);

}  // namespace fbs
