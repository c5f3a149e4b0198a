// Streams for the decoder's tests, and a decoder's output for them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/motion/motion_encoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/return_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/track.h"
#include "decoder/stream/stream_decoder.h"
#include "encoder/patterns/pattern_encoder.h"
#include "tests/unit/toy_scene.h"

namespace fbs {

using Bytes = std::vector<std::uint8_t>;

inline constexpr int kWidth = 96, kHeight = 80;

/// @param patterns  slots of the store
inline Setup setup_of(int patterns = 1) {
  Setup setup = toy_setup(kWidth, kHeight);
  setup.format.frame_rate = {30, 1};
  setup.patterns = patterns;
  return setup;
}

/// One pattern; the scene begins there.
inline Setup setup_at(const StreamPosition& before) {
  Setup setup = setup_of();
  setup.before = before;
  return setup;
}

/// A head that yaws and moves, again and again.
inline CodedState coded_at(int time) {
  time %= 100;
  CodedState s = coded_pose(toy_state(48, 34));
  s[kLogScale] = 4 * 4096;
  s[kYaw] = time * 150;
  s[kShiftX] += time * 20;
  s[kPoseCount + kLightOffset] = time * 9;
  s[kFirstCoefficient] = time * 25;
  return s;
}

inline Picture face_picture(int seed) {
  Picture p(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      p.y.row(y)[x] =
          static_cast<std::uint8_t>(120 + 50 * std::sin(x * 0.2 + seed) + 50 * std::cos(y * 0.17));
  return p;
}

/// Writes streams packet by packet, in any order.
class Writer {
 public:
  Writer() { write_signature(bytes); }

  Writer& packet(PacketType type, const Result<Bytes>& payload) {
    EXPECT_TRUE(payload);
    begins.push_back(bytes.size());
    check_ = packets_.write(bytes, type, *payload);
    return *this;
  }
  Writer& setup(const Setup& s = setup_of()) {
    scenes_.push_back({s, MotionEncoder(s, coded_at(0)), *PatternEncoder::create(s.format, 50), {}, {}});
    present_ = scenes_.size() - 1;
    return packet(PacketType::kSetup, encode_setup(s));
  }
  /// @param scene  by the setups so far, from 0
  /// @param passed  pictures of it before
  Writer& go_back(std::size_t scene, const StreamPosition& before, bool aside = true,
                  std::uint32_t passed = 0) {
    present_ = scene;
    return packet(PacketType::kReturn, encode_return({now().check, before, aside, passed}));
  }
  Writer& geometry() { return packet(PacketType::kGeometry, encode_geometry(toy_geometry())->payload); }
  Writer& surround(int follow = 2) {
    return packet(PacketType::kSurround, encode_surround(even_surround(6, 5, follow)));
  }
  /// The first of the scene, of picture 0.
  Writer& pattern(const Picture& picture = face_picture(0)) {
    return patterns({{0, 0, coded_at(0), frame(picture)}});
  }
  /// A later one.
  /// @param number  of the picture whose state it was seen in
  Writer& pattern(const Picture& picture, int slot, int number) {
    return patterns({{slot, number, {}, frame(picture)}});
  }
  /// The AV1 frame after the frames of the patterns so far.
  [[nodiscard]] Bytes frame(const Picture& picture) { return *now().av1.encode(picture); }
  /// Any, in one packet.
  Writer& patterns(const std::vector<PatternSyntax>& patterns) {
    Setup wide = now().setup;  // a writer may be wrong
    wide.patterns = kMaxPatterns;
    packet(PacketType::kPattern,
           now().patterns.encode(patterns, wide, std::max(now().pictures, told_pictures)));
    if (patterns.front().picture == 0) now().check = check_;
    return *this;
  }
  /// Pictures `from`..`end` - 1.
  Writer& motion(int from, int end, bool key = false, std::vector<std::uint32_t> durations = {}) {
    std::vector<CodedState> states;
    for (int t = from; t < end; ++t) states.push_back(coded_at(t));
    MotionGroup group = knots_everywhere(now().motion.anchor(), states, now().setup.parts);
    group.key = key;
    group.first = now().motion.next();
    group.durations = std::move(durations);
    now().pictures += end - from;
    return packet(PacketType::kMotion, now().motion.encode(group));
  }
  /// Releases the next pictures, all regions of which have one mode.
  Writer& blend(std::size_t pictures, BlendMode mode = {}, bool key = false) {
    RegionModes modes;
    modes.fill(mode);
    BlendEncoder& blend = now().blend;
    return packet(PacketType::kBlend,
                  blend.encode({key || blend.groups() == 0, blend.next(), 0, {pictures, modes}}));
  }
  /// A scene of one pattern: pictures 0..`pictures` - 1.
  Writer& scene(const StreamPosition& before, int pictures, std::vector<std::uint32_t> durations = {}) {
    return setup(setup_at(before))
        .geometry()
        .surround()
        .pattern()
        .motion(0, pictures, true, std::move(durations));
  }
  Writer& end(std::uint64_t pictures) { return packet(PacketType::kEnd, encode_end({pictures})); }

  Bytes bytes;
  std::vector<std::size_t> begins;
  int told_pictures = 0;  ///< that have a state, where the writer thinks of more than there are

 private:
  struct OfScene {
    Setup setup;
    MotionEncoder motion;
    PatternEncoder av1;
    PatternPacketWriter patterns;
    BlendEncoder blend;
    int pictures = 0;         // that have a state
    std::uint32_t check = 0;  // of the first pattern packet
  };
  OfScene& now() { return scenes_[present_]; }

  PacketWriter packets_;
  std::uint32_t check_ = 0;  // of the last packet
  std::vector<OfScene> scenes_;
  std::size_t present_ = 0;
};

/// Four groups of five pictures; the third is a key group.
inline const Writer& sample() {
  static const Writer w = [] {
    Writer s;
    s.setup().geometry().surround().pattern();
    s.motion(0, 5, true).motion(5, 10).motion(10, 15, true).motion(15, 20).end(20);
    return s;
  }();
  return w;
}

/// A scene up to its first pattern.
inline Writer begun(int patterns = 3) {
  Writer w;
  w.setup(setup_of(patterns)).geometry().surround().pattern();
  return w;
}

/// What a decoder returns for a stream.
struct Played {
  std::vector<Picture> pictures;
  std::vector<std::uint32_t> durations;
  std::vector<StreamPosition> positions;
  std::vector<bool> held;
  std::vector<Error> errors;
  ByteCount bytes;
  std::optional<std::uint64_t> announced;
};

/// Plays what has arrived; returns true at the end.
inline bool play(StreamDecoder& decoder, Played& result) {
  for (int guard = 0; guard < 10000; ++guard) {
    const auto status = decoder.next();
    if (!status) {
      EXPECT_NE(status.error().code, ErrorCode::kInternal) << status.error().text;
      result.errors.push_back(status.error());
      continue;
    }
    result.bytes = decoder.bytes();
    result.announced = decoder.announced_pictures();
    if (*status == DecodeStatus::kEnd) return true;
    if (*status == DecodeStatus::kNeedMore) return false;
    result.pictures.emplace_back();
    EXPECT_TRUE(decoder.render(result.pictures.back()));
    result.durations.push_back(decoder.duration());
    result.positions.push_back(decoder.position());
    result.held.push_back(decoder.held());
  }
  ADD_FAILURE() << "a decoder that never ends";
  return true;
}

/// Plays all of a stream without errors; the decoder stays as it is at the end.
inline void play_through(StreamDecoder& decoder, const Writer& w, Played& result) {
  decoder.feed(w.bytes);
  decoder.close();
  ASSERT_TRUE(play(decoder, result));
  ASSERT_TRUE(result.errors.empty()) << result.errors.front().text;
}

inline Played played(std::span<const std::uint8_t> bytes) {
  StreamDecoder decoder;
  decoder.feed(bytes);
  decoder.close();
  Played result;
  EXPECT_TRUE(play(decoder, result));
  return result;
}

/// Has the whole stream, of which nothing is read yet, and will record its patterns.
inline StreamDecoder recording_decoder(const Writer& w) {
  StreamDecoder decoder;
  decoder.record_patterns();
  decoder.feed(w.bytes);
  decoder.close();
  return decoder;
}

inline std::uint64_t sum_of(const ByteCount& b) {
  return b.geometry + b.patterns + b.motion + b.other;
}

/// The first error of a stream.
inline ErrorCode first_error(const Writer& w) {
  const Played result = played(w.bytes);
  EXPECT_FALSE(result.errors.empty());
  return result.errors.empty() ? ErrorCode::kInternal : result.errors[0].code;
}

}  // namespace fbs
