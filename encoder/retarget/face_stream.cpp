#include "encoder/retarget/face_stream.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "bitstream/motion/motion_decoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/payload/wire_frame_payload.h"
#include "bitstream/track.h"
#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"

namespace fbs {
namespace {

Error at(const Packet& packet, const Error& error) {
  return {error.code, error.text, packet.offset};
}

/// Mean light of the mouth interior, over pictures weighted by mouth opening.
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

/// Reads the packets of a stream up to the end of the first scene with a face.
class Reading {
 public:
  /// @return false when the scene is complete
  Result<bool> take(const Packet& packet) {
    if (packet.type == PacketType::kSetup || packet.type == PacketType::kEnd) {
      if (has_face()) return false;
      if (packet.type == PacketType::kEnd) return true;
      return begin(packet);
    }
    switch (packet.type) {
      case PacketType::kWireFrame:
        return take_wire_frame(packet);
      case PacketType::kGeometry:
        return take_geometry(packet);
      case PacketType::kSurround:
        return take_surround(packet);
      case PacketType::kPattern:
        return take_patterns(packet);
      case PacketType::kMotion:
        return take_motion(packet);
      default:
        return true;
    }
  }

  [[nodiscard]] bool has_face() const { return motion_.has_value() && !face_.geometry_payload.empty(); }

  FaceStream finish() {
    face_.interior = interior_.mean();
    return std::move(face_);
  }

 private:
  Result<bool> begin(const Packet& packet) {
    *this = {};
    auto setup = decode_setup(packet.payload);
    if (!setup) return fail(at(packet, setup.error()));
    face_.setup = *setup;
    return true;
  }

  Result<bool> take_wire_frame(const Packet& packet) {
    if (motion_) return true;  // has no effect
    auto frame = decode_wire_frame(packet.payload);
    if (!frame) return fail(at(packet, frame.error()));
    wire_frame_ = std::move(*frame);
    face_.wire_frame_payload.assign(packet.payload.begin(), packet.payload.end());
    return true;
  }

  Result<bool> take_geometry(const Packet& packet) {
    if (motion_) return true;  // has no effect
    const auto geometry = decode_geometry(packet.payload, wire_frame_);
    if (!geometry) return fail(at(packet, geometry.error()));
    if (is_flat(*geometry)) return true;
    face_.geometry = *geometry;
    face_.geometry_payload.assign(packet.payload.begin(), packet.payload.end());
    return true;
  }

  Result<bool> take_surround(const Packet& packet) {
    auto map = decode_surround(packet.payload);
    if (!map) return fail(at(packet, map.error()));
    face_.surround = std::move(*map);
    return true;
  }

  Result<bool> take_patterns(const Packet& packet) {
    auto patterns = packets_.decode(packet.payload, face_.setup, pictures());
    if (!patterns) return fail(at(packet, patterns.error()));
    for (PatternSyntax& pattern : *patterns) {
      if (!motion_) {
        motion_.emplace(face_.setup, pattern.state);
        face_.rest = state_of(pattern.state, face_.setup.steps);
        face_.first = std::move(pattern);
      } else if (static_cast<std::size_t>(pattern.slot) == face_.later.size() + 1) {
        face_.later.push_back(
            {states_.at(static_cast<std::size_t>(pattern.picture)), std::move(pattern.av1)});
      } else {
        return has_face() ? Result<bool>(false) : Result<bool>(true);  // a replacement: the store is full
      }
    }
    return true;
  }

  Result<bool> take_motion(const Packet& packet) {
    if (!motion_) return fail(ErrorCode::kInvalidStream, "motion before the first pattern", packet.offset);
    const auto group = motion_->decode(packet.payload);
    if (!group) return fail(at(packet, group.error()));
    for (const State& state : states_of(*group, face_.setup.steps)) {
      if (has_face()) interior_.add(face_.geometry, state);
      states_.push_back(state);
    }
    return true;
  }

  [[nodiscard]] std::int32_t pictures() const { return static_cast<std::int32_t>(states_.size()); }

  FaceStream face_;
  std::shared_ptr<const WireFrame> wire_frame_;
  PatternPacketReader packets_;
  std::optional<MotionDecoder> motion_;
  std::vector<State> states_;  ///< of each picture of the scene
  InteriorMean interior_;
};

}  // namespace

Result<FaceStream> read_face_stream(std::span<const std::uint8_t> stream) {
  PacketReader reader;
  reader.feed(stream);
  reader.close();
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
