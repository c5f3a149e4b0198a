// Paint of the eyes: eyeball with iris, pupil and highlight behind the lids' opening; lashes and folds
// around.
#pragma once

#include <optional>

#include "tests/talker/talker_paint.h"

namespace fbs::talker {

/// The eyeball seen through the opening of the lids, or nothing where skin is; `rest` is in the rest face.
[[nodiscard]] std::optional<Material> paint_eyeball(glm::vec3 rest, const Expression& e, const Look& look,
                                                    const Arrival& arrival);

/// Lash lines and the fold of the upper lid, over skin.
void paint_lids(Material& skin, glm::vec3 rest, const Expression& e, const Look& look);

}  // namespace fbs::talker
