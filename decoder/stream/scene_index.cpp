#include "decoder/stream/scene_index.h"

#include <map>
#include <utility>

#include "bitstream/packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/return_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/wire_frame_payload.h"

namespace fbs {
namespace {

/// Takes the packets of a stream one by one.
class Indexer {
 public:
  void take(const Packet& packet) {
    if (packet.type == PacketType::kSetup) begin(packet);
    if (packet.type == PacketType::kReturn) go_on(packet);
    if (packet.type == PacketType::kEnd) close(packet.offset);
    if (packet.type == PacketType::kWireFrame && open_) {
      const auto frame = decode_wire_frame(packet.payload);
      lost_ = lost_ || !frame;
      wire_frame_ = frame.value_or(nullptr);
    }
    if (packet.type == PacketType::kGeometry && open_ && !lost_) {
      const auto geometry = decode_geometry(packet.payload, wire_frame_);
      scenes_.back().face = geometry && !is_flat(*geometry);
    }
    if (packet.type == PacketType::kPattern && open_ && in_head_) {
      faces_[packet.check] = scenes_.back().face;
      in_head_ = false;
    }
  }

  /// @param size  of the stream, bytes
  [[nodiscard]] std::vector<SceneEntry> finish(std::uint64_t size) {
    close(size);
    return std::move(scenes_);
  }

 private:
  void begin(const Packet& packet) {
    close(packet.offset);
    const auto setup = decode_setup(packet.payload);
    if (!setup) return;
    open(packet, setup->before);
    if (!open_) return;
    scenes_.back().is_joinable = setup->keeps == SceneKeeping::kNone;
    in_head_ = true;
    lost_ = false;
    wire_frame_.reset();
  }

  void go_on(const Packet& packet) {
    close(packet.offset);
    const auto to = decode_return(packet.payload);
    if (to) open(packet, to->before);
    if (!open_) return;
    scenes_.back().is_return = true;
    scenes_.back().face = faces_[to->scene];
    in_head_ = false;
    lost_ = true;  // its head has been read
  }

  void open(const Packet& packet, const StreamPosition& before) {
    if (!scenes_.empty() &&
        (before.pictures < scenes_.back().before.pictures || before.time < scenes_.back().before.time))
      return;
    scenes_.push_back({before, packet.offset});
    open_ = true;
  }

  void close(std::uint64_t offset) {
    if (open_) scenes_.back().bytes = offset - scenes_.back().offset;
    open_ = false;
  }

  std::vector<SceneEntry> scenes_;
  std::map<std::uint32_t, bool> faces_;  // by the check of the first pattern
  bool open_ = false;                    // the last scene continues
  bool in_head_ = false;                 // its first pattern is to come
  bool lost_ = false;                    // the rest of that scene
  std::shared_ptr<const WireFrame> wire_frame_;
};

}  // namespace

std::vector<SceneEntry> index_scenes(std::span<const std::uint8_t> stream) {
  PacketReader reader(stream);
  Indexer indexer;
  for (;;) {
    const auto read = reader.next();
    if (!read) continue;
    if (read->status != ReadStatus::kPacket) return indexer.finish(stream.size());
    indexer.take(read->packet);
  }
}

const SceneEntry* scene_at(std::span<const SceneEntry> scenes, std::uint64_t time) {
  const SceneEntry* found = nullptr;
  for (const SceneEntry& scene : scenes)
    if (scene.is_joinable && (found == nullptr || scene.before.time <= time)) found = &scene;
  return found;
}

}  // namespace fbs
