#include "encoder/scene/scene_packets.h"

#include <cassert>
#include <utility>

namespace fbs {

ScenePackets::ScenePackets(const LiveSettings& live) {
  if (live.join > 0 || live.resilience == Resilience::kStrong) trickle_.emplace(live.join);
}

void ScenePackets::add_motion(std::span<const std::uint8_t> payload) {
  if (started_)
    writer_.write(ready_, PacketType::kMotion, payload);
  else
    held_back_.emplace_back(payload.begin(), payload.end());
}

void ScenePackets::add(PacketType type, std::span<const std::uint8_t> payload) {
  assert(started_);
  writer_.write(ready_, type, payload);
}

void ScenePackets::start(const SceneHead& head) {
  assert(!started_);
  for (const auto& [type, payload] : {std::pair{PacketType::kSetup, &head.setup},
                                      {PacketType::kGeometry, &head.geometry},
                                      {PacketType::kSurround, &head.surround},
                                      {PacketType::kPattern, &head.pattern}})
    if (!payload->empty()) writer_.write(ready_, type, *payload);
  for (const auto& payload : held_back_) writer_.write(ready_, PacketType::kMotion, payload);
  held_back_.clear();
  started_ = true;
}

void ScenePackets::show_trickle() {
  if (trickle_) trickle_->add(std::span(ready_).subspan(shown_));
  shown_ = ready_.size();
}

void ScenePackets::end_group() {
  if (!trickle_ || !started_) return;
  show_trickle();
  for (const auto& [type, payload] : trickle_->due()) add(type, payload);
}

void ScenePackets::begin_again() {
  assert(started_ && held_back_.empty());
  started_ = false;
}

std::vector<std::uint8_t> ScenePackets::take() {
  show_trickle();
  shown_ = 0;
  written_ += ready_.size();
  return std::exchange(ready_, {});
}

}  // namespace fbs
