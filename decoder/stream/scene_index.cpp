#include "decoder/stream/scene_index.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "bitstream/packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/wire_frame_payload.h"

namespace fbs {
namespace {

/// Takes the packets of a stream one by one.
class Indexer {
 public:
  void take(const Packet& packet) {
    if (packet.type == PacketType::kSetup) begin(packet);
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
    if (!scenes_.empty() && (setup->before.pictures < scenes_.back().before.pictures ||
                             setup->before.time < scenes_.back().before.time))
      return;
    scenes_.push_back({setup->before, packet.offset, 0, false});
    open_ = true;
    lost_ = false;
    wire_frame_.reset();
  }

  void close(std::uint64_t offset) {
    if (open_) scenes_.back().bytes = offset - scenes_.back().offset;
    open_ = false;
  }

  std::vector<SceneEntry> scenes_;
  bool open_ = false;  // the last scene goes on
  bool lost_ = false;  // what is left of it
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
  if (scenes.empty()) return nullptr;
  const auto later =
      std::upper_bound(scenes.begin(), scenes.end(), time,
                       [](std::uint64_t t, const SceneEntry& scene) { return t < scene.before.time; });
  return later == scenes.begin() ? &scenes.front() : &*std::prev(later);
}

}  // namespace fbs
