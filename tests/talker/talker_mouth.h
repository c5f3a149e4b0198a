// Paint of the mouth: lips, and teeth, tongue and darkness behind them.
#pragma once

#include <optional>

#include "tests/talker/talker_paint.h"

namespace fbs::talker {

/// What is seen through the open lips at `position` of the moved face, or nothing where there is skin.
[[nodiscard]] std::optional<Material> paint_mouth_inside(glm::vec3 position, const Expression& e,
                                                         const Look& look, const Arrival& arrival);

/// Lips and the line between them, over skin.
void paint_lips(Material& skin, glm::vec3 rest, const Expression& e, const Look& look, float pixels_per_unit);

}  // namespace fbs::talker
