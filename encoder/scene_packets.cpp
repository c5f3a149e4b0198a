#include "encoder/scene_packets.h"

#include <cassert>
#include <utility>

#include "bitstream/packet.h"

namespace fbs {

void ScenePackets::add_motion(std::span<const std::uint8_t> payload) {
  write_packet(started_ ? ready_ : held_back_, PacketType::kMotion, payload);
}

void ScenePackets::add(PacketType type, std::span<const std::uint8_t> payload) {
  assert(started_);
  write_packet(ready_, type, payload);
}

void ScenePackets::start(const SceneHead& head) {
  assert(!started_);
  for (const auto& [type, payload] : {std::pair{PacketType::kSetup, &head.setup},
                                      {PacketType::kGeometry, &head.geometry},
                                      {PacketType::kSurround, &head.surround},
                                      {PacketType::kPattern, &head.pattern}})
    if (!payload->empty()) write_packet(ready_, type, *payload);
  ready_.insert(ready_.end(), held_back_.begin(), held_back_.end());
  held_back_.clear();
  started_ = true;
}

void ScenePackets::begin_again() {
  assert(started_ && held_back_.empty());
  started_ = false;
}

std::vector<std::uint8_t> ScenePackets::take() {
  return std::exchange(ready_, {});
}

}  // namespace fbs
