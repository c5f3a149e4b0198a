// A talker's clip that is quick to render.
#pragma once

#include "tests/talker/talker_render.h"

namespace fbs::talker {

inline Settings small() {
  Settings settings;
  settings.width = 96;
  settings.height = 80;
  settings.frame_count = 120;
  return settings;
}

/// The frame with the most open mouth.
inline int most_open(const Talker& talker) {
  int best = 0;
  for (int i = 0; i < talker.settings().frame_count; ++i) {
    if (talker.truth(i).expression.mouth_open > talker.truth(best).expression.mouth_open) best = i;
  }
  return best;
}

}  // namespace fbs::talker
