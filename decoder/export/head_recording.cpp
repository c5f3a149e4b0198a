#include "decoder/export/head_recording.h"

#include <algorithm>
#include <cmath>

#include "decoder/scene/scene_face.h"

namespace fbs {

std::size_t HeadRecording::head_of(const Scene& scene) {
  const SceneGeometry* face = face_of(scene);
  if (face == nullptr || scene.patterns.empty()) return ShownHead::kNone;
  const auto known = std::find_if(heads_.begin(), heads_.end(),
                                  [&](const RecordedHead& h) { return h.geometry == face->geometry(); });
  if (known != heads_.end()) return static_cast<std::size_t>(known - heads_.begin());
  const Pattern& first = scene.patterns.front();
  heads_.push_back({face->geometry(), first.picture, first.seen, scene.setup.mouth, {}});
  return heads_.size() - 1;
}

void HeadRecording::add(const Scene& scene, const State& state, std::uint64_t time, std::uint32_t duration) {
  if (shown_.empty()) {
    format_ = scene.setup.format;
    first_ = time;
  }
  end_ = time + duration;
  times_.push_back(time - first_);
  const std::size_t head = head_of(scene);
  if (shown_.empty() || shown_.back().head != head) shown_.push_back({time - first_, head});
  if (head != ShownHead::kNone) heads_[head].states.push_back({time - first_, state});
}

double HeadRecording::first_scale() const {
  return std::exp2(heads_.front().states.front().state.pose[kLogScale] / 4096.0);
}

}  // namespace fbs
