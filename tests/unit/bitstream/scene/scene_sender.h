// Packets of scenes as their encoder makes them, read one by one.
#pragma once

#include <gtest/gtest.h>

#include <numeric>
#include <optional>
#include <vector>

#include "bitstream/motion/motion_encoder.h"
#include "bitstream/payload/return_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/scene/scene_reader.h"
#include "bitstream/track.h"
#include "tests/unit/toy_scene.h"

/// A namespace of its own, since other tests have senders and states of theirs.
namespace fbs::scene_sender {

using Bytes = std::vector<std::uint8_t>;

/// The number of a picture, as its yaw.
inline CodedState coded_at(int picture) {
  CodedState state{};
  state[kYaw] = picture % 1000;
  return state;
}

/// Payloads of one scene, read one by one. What stands for AV1 is not looked at.
class Sender {
 public:
  explicit Sender(int patterns = 1) {
    setup.format.frame_rate = {30, 1};
    setup.patterns = patterns;
    motion_.emplace(setup, CodedState{});
  }

  Result<SceneSyntax> read(PacketType type, const Result<Bytes>& payload) {
    EXPECT_TRUE(payload) << payload.error().text;
    if (loses) return SceneSyntax{};
    payload_ = *payload;
    payload_.insert(payload_.end(), excess, 0x55);
    return reader.read({type, 77, payload_, packet_size(payload_.size()), false, check});
  }
  Result<SceneSyntax> begin() { return read(PacketType::kSetup, encode_setup(setup)); }
  Result<SceneSyntax> pattern(int slot, int picture, bool alone = false) {
    return patterns({{slot, picture, {}, {1, 2, 3}, alone}});
  }
  Result<SceneSyntax> patterns(const std::vector<PatternSyntax>& patterns) {
    Setup wide = setup;
    wide.patterns = kMaxPatterns;
    return read(PacketType::kPattern, patterns_.encode(patterns, wide, motion_->next()));
  }
  /// @param every  one picture in this many has a knot, and the last
  Result<SceneSyntax> motion(int pictures, bool key = false, int every = 1) {
    std::vector<CodedState> states;
    for (int i = 0; i < pictures; ++i) states.push_back(coded_at(motion_->next() + i));
    MotionGroup group = knots_everywhere(motion_->anchor(), states, setup.parts);
    group.key = key || motion_->groups() == 0;
    group.first = motion_->next();
    for (Track& track : group.tracks)
      std::erase_if(track,
                    [&](const Knot& k) { return (k.picture + 1) % every != 0 && k.picture + 1 < pictures; });
    return read(PacketType::kMotion, motion_->encode(group));
  }
  Result<SceneSyntax> blend(std::size_t pictures, BlendMode mode = {}, bool key = false) {
    RegionModes modes;
    modes.fill(mode);
    return read(PacketType::kBlend,
                blend_.encode({key || blend_.groups() == 0, blend_.next(), 0, std::vector(pictures, modes)}));
  }

  Setup setup = toy_setup(96, 80);
  SceneReader reader;
  bool loses = false;      // packets do not arrive
  std::size_t excess = 0;  // bytes behind each payload
  std::uint32_t check = 0;

 private:
  Bytes payload_;
  std::optional<MotionEncoder> motion_;
  PatternPacketWriter patterns_;
  BlendEncoder blend_;
};

/// A scene that has begun.
inline Sender begun(int patterns, int pictures) {
  Sender s(patterns);
  EXPECT_TRUE(s.begin());
  EXPECT_TRUE(s.pattern(0, 0));
  EXPECT_TRUE(s.motion(pictures));
  return s;
}

/// Whether a packet was read and nothing of it can be used.
inline bool skipped(const Result<SceneSyntax>& read) {
  return read && std::holds_alternative<std::monostate>(*read);
}

/// Picture numbers of the patterns of a packet, as their states tell; none for any other packet.
inline std::vector<int> seen_in(const Result<SceneSyntax>& read) {
  std::vector<int> out;
  if (const auto* const patterns = read ? std::get_if<std::vector<ScenePattern>>(&*read) : nullptr)
    for (const ScenePattern& p : *patterns) out.push_back(p.seen.pose[kYaw]);
  return out;
}

/// Yaws of the released pictures, and modes.
inline std::vector<int> shown(SceneReader& reader, std::vector<BlendMode>* modes = nullptr) {
  std::vector<int> out;
  while (reader.pictures().has_next()) {
    const State state = reader.pictures().next().state;
    out.push_back(state.pose[kYaw]);
    if (modes) modes->push_back(state.blend[0]);
  }
  return out;
}

inline std::vector<int> numbers(int begin, int end) {
  std::vector<int> out(static_cast<std::size_t>(end - begin));
  std::iota(out.begin(), out.end(), begin);
  return out;
}

}  // namespace fbs::scene_sender
