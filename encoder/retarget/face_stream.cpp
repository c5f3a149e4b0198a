#include "encoder/retarget/face_stream.h"

#include <algorithm>
#include <array>
#include <utility>

#include "bitstream/packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/sound_payload.h"
#include "bitstream/scene/scene_reader.h"
#include "bitstream/track.h"
#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {
namespace {

/// Mean light of the mouth interior, over pictures by how far the mouth is open.
class InteriorMean {
 public:
  void add(const Geometry& geometry, const State& state) {
    const double gap = std::max(0, mouth_gap(geometry, state));
    for (std::size_t i = 0; i < kInteriorCount; ++i) sum_[i] += gap * state.interior[i];
    weight_ += gap;
  }
  [[nodiscard]] std::array<double, kInteriorCount> mean() const {
    std::array<double, kInteriorCount> out{};
    for (std::size_t i = 0; i < kInteriorCount && weight_ > 0; ++i) out[i] = sum_[i] / weight_;
    return out;
  }

 private:
  std::array<double, kInteriorCount> sum_{};
  double weight_ = 0;
};

/// Reads the packets of the first scene with a face, up to where the stream cannot return to it any more.
class Reading {
 public:
  /// @return false when the scene is complete
  Result<bool> take(const Packet& packet) {
    if (packet.type == PacketType::kEnd) return !has_face();
    if (is_sound(packet.type)) return true;
    auto syntax = reader_.read(packet);
    while (reader_.pictures().has_next()) (void)reader_.pictures().next();
    const bool elsewhere = has_face() && (reader_.scene() != scene_ || reader_.lost());
    if (elsewhere) return syntax && reader_.knows(scene_);
    if (!syntax) return fail(syntax.error());
    return std::visit([&](auto& s) { return take(s, packet); }, *syntax);
  }

  [[nodiscard]] bool has_face() const { return has_pattern_ && !face_.geometry_payload.empty(); }

  FaceStream finish() {
    face_.interior = interior_.mean();
    return std::move(face_);
  }

 private:
  bool take(const Setup& setup, const Packet& /*packet*/) {
    face_ = {};
    scene_ = reader_.scene();
    face_.setup = setup;
    has_pattern_ = false;
    interior_ = {};
    return true;
  }

  bool take(const std::shared_ptr<const WireFrame>& /*frame*/, const Packet& packet) {
    face_.wire_frame_payload.assign(packet.payload.begin(), packet.payload.end());
    return true;
  }

  bool take(const Geometry& geometry, const Packet& packet) {
    if (is_flat(geometry)) return true;
    face_.geometry = geometry;
    face_.geometry_payload.assign(packet.payload.begin(), packet.payload.end());
    return true;
  }

  bool take(SurroundMap& map, const Packet& /*packet*/) {
    face_.surround = std::move(map);
    return true;
  }

  bool take(std::vector<ScenePattern>& patterns, const Packet& /*packet*/) {
    for (ScenePattern& pattern : patterns) {
      if (pattern.is_first()) {
        has_pattern_ = true;
        face_.rest = pattern.seen;
        face_.first = std::move(pattern.coded);
      } else if (static_cast<std::size_t>(pattern.coded.slot) == face_.later.size() + 1) {
        face_.later.push_back({pattern.seen, std::move(pattern.coded.av1)});
      } else {
        return !has_face();  // replaces one: the store is full
      }
    }
    return true;
  }

  bool take(const MotionGroup& group, const Packet& /*packet*/) {
    if (has_face())
      for (const State& state : states_of(group, face_.setup.steps)) interior_.add(face_.geometry, state);
    return true;
  }

  template <class Syntax>
  bool take(const Syntax& /*syntax*/, const Packet& /*packet*/) {
    return true;
  }

  SceneReader reader_;
  std::uint64_t scene_ = 0;  // of face_
  FaceStream face_;
  bool has_pattern_ = false;
  InteriorMean interior_;
};

}  // namespace

Result<FaceStream> read_face_stream(std::span<const std::uint8_t> stream) {
  PacketReader reader(stream);
  Reading reading;
  for (;;) {
    const auto read = reader.next();
    if (!read) return fail(read.error());
    if (read->status != ReadStatus::kPacket) break;
    const auto more = reading.take(read->packet);
    if (!more) return fail(more.error());
    if (!*more) break;
  }
  if (!reading.has_face()) return fail(ErrorCode::kDegenerateInput, "has no face");
  return reading.finish();
}

}  // namespace fbs
