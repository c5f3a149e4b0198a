#include "decoder/stream/held_picture.h"

#include <utility>

namespace fbs {

void HeldPicture::show(const State& state, const StreamPosition& position, std::uint32_t duration,
                       Scene& scene) {
  hold(position, duration);
  held_ = false;
  state_ = state;
  past_.reset();
  kept_.reset();
  store_arrivals(scene);
}

void HeldPicture::hold(const StreamPosition& position, std::uint32_t duration) {
  ++announced_;
  position_ = position;
  duration_ = duration;
  held_ = true;
}

void HeldPicture::end_scene(Scene& scene) {
  if (announced_ > 0 && !past_) past_ = std::move(scene);
  arrivals_.clear();
}

Result<void> HeldPicture::add(Pattern pattern, Scene& scene, Renderer& renderer) {
  const bool waits = announced_ > 0 && !past_ && !kept_;
  if (waits && arrivals_.size() == kMaxArrivals)
    if (auto drawn = draw(scene, renderer); !drawn) return drawn;
  arrivals_.push_back(std::move(pattern));
  if (!waits || kept_) store_arrivals(scene);
  return {};
}

Result<void> HeldPicture::keep(Scene& scene, Renderer& renderer) {
  if (auto drawn = draw(scene, renderer); !drawn) return drawn;
  store_arrivals(scene);
  return {};
}

Result<void> HeldPicture::draw(const Scene& scene, Renderer& renderer) {
  if (announced_ == 0 || past_ || kept_) return {};
  Picture picture;
  if (auto drawn = renderer.render(scene, state_, picture); !drawn) return drawn;
  kept_ = Scene{scene.setup, std::nullopt, {}};
  kept_->patterns.push_back(make_pattern(std::move(picture), state_, std::nullopt));
  return {};
}

void HeldPicture::store_arrivals(Scene& scene) {
  for (Pattern& pattern : arrivals_) scene.store(std::move(pattern));
  arrivals_.clear();
}

}  // namespace fbs
