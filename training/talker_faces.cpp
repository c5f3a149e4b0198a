#include "training/talker_faces.h"

#include <algorithm>
#include <random>

#include "tests/talker/talker_render.h"

namespace fbs {

std::vector<DrawnFace> draw_talkers(int count) {
  std::mt19937 random(1);
  std::vector<DrawnFace> out(static_cast<std::size_t>(count));
  for (DrawnFace& face : out) {
    talker::Settings settings;
    settings.width = 256;
    settings.height = 256;
    settings.seed = static_cast<std::uint32_t>(random() % 100000);
    settings.light = 0.3F;
    settings.yaw_deg = 25;
    settings.pitch_deg = 12;
    settings.eye_distance = 0.25F;
    const talker::Talker talker(settings);
    const auto frame = static_cast<int>(random() % static_cast<unsigned>(settings.frame_count));
    face.luma = talker.picture(frame).y;
    std::ranges::transform(talker.points(frame), face.landmarks.begin(),
                           [](glm::vec2 p) { return p + 0.5F; });
  }
  return out;
}

}  // namespace fbs
