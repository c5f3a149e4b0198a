#include "tests/vectors/limits_vectors.h"

#include <random>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/motion/motion_encoder.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "decoder/head/head_projection.h"
#include "encoder/patterns/pattern_encoder.h"

namespace fbs {
namespace {

constexpr int kWidth = 65, kHeight = 64, kGroupPictures = 20;

/// Tracks of random knots at and between the limits of every number. No encoder writes such a group, but all
/// decoders must draw it alike.
MotionGroup group_at_limits(std::mt19937& random, const CodedLimits& limits, const CodedState& anchor) {
  MotionGroup group;
  group.anchor = anchor;
  group.pictures = kGroupPictures;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    for (std::int32_t t = 0; t < group.pictures; ++t) {
      if (t + 1 < group.pictures && random() % 3 != 0) continue;
      Knot knot{.picture = t, .value = {}};
      for (std::size_t k = 0; k < kPartSizes[part]; ++k) {
        const std::size_t i = kPartFirst[part] + k;
        const auto range = static_cast<unsigned>(limits.max[i] - limits.min[i] + 1);
        knot.value[k] = random() % 6 == 0   ? limits.max[i]
                        : random() % 6 == 0 ? limits.min[i]
                                            : limits.min[i] + static_cast<int>(random() % range);
      }
      group.tracks[part].push_back(knot);
    }
  }
  return group;
}

Setup setup_at_limits() {
  Setup setup;
  setup.format.width = kWidth;
  setup.format.height = kHeight;
  setup.format.frame_rate = {30, 1};
  setup.steps = {512, 4096, 1024, 256, 1024};
  return setup;
}

SurroundMap random_surround(std::mt19937& random) {
  SurroundMap surround{7, 5, {}, {}};
  const auto share = [&] { return static_cast<std::uint8_t>(random() % (kFollowOne + 1)); };
  for (int k = 0; k < 8 * 6; ++k) {
    surround.head.push_back(share());
    surround.body.push_back(surround.head.back() == kFollowOne ? std::uint8_t{0} : share());
  }
  return surround;
}

CodedState seen_in_the_middle(const Setup& setup) {
  CodedState seen{};
  seen[kShiftX] = (32 << kScreenOneLog2) / setup.steps.translation;
  seen[kLogScale] = 4 * 4096 / setup.steps.log_scale;
  return seen;
}

/// All that precedes the motion.
std::vector<Piece> beginning(const Setup& setup, const CodedState& seen, std::mt19937& random,
                             const Bytes& av1, PatternPacketWriter& patterns) {
  Geometry geometry;
  for (std::size_t v = 0; v < kVertexCount; ++v) geometry.positions[v] = generic_head().vertices[v].position;
  PatternSyntax pattern;
  pattern.state = seen;
  pattern.av1 = av1;
  return {{PacketType::kSetup, must(encode_setup(setup))},
          {PacketType::kGeometry, must(encode_geometry(geometry)).payload},
          {PacketType::kSurround, must(encode_surround(random_surround(random)))},
          {PacketType::kPattern, must(patterns.encode({&pattern, 1}, setup, 0))}};
}

Piece motion_at_limits(MotionEncoder& coder, std::mt19937& random) {
  MotionGroup group = group_at_limits(random, coder.limits(), coder.anchor());
  group.key = coder.groups() == 0;
  group.first = coder.next();
  return {PacketType::kMotion, must(coder.encode(group))};
}

/// All numbers of the state, at and between their limits.
Bytes limits_stream() {
  const Setup setup = setup_at_limits();
  std::mt19937 random(1);
  const CodedState seen = seen_in_the_middle(setup);
  auto av1 = must(PatternEncoder::create(setup.format, 40));
  PatternPacketWriter patterns;
  auto pieces = beginning(setup, seen, random,
                          must(av1.encode(pictures_of(talker_settings(kWidth, kHeight, 1))[0])), patterns);
  MotionEncoder coder(setup, seen);
  for (int i = 0; i < 2; ++i) pieces.push_back(motion_at_limits(coder, random));
  return joined(pieces);
}

RegionModes random_modes(std::mt19937& random) {
  RegionModes modes;
  for (BlendMode& mode : modes) mode = static_cast<BlendMode>(random() % kBlendModeCount);
  return modes;
}

/// The same, blended from patterns that were seen at the limits, in random modes.
Bytes blended_limits_stream() {
  constexpr int kPatterns = 12, kPatternsAfterMotion = 8;
  Setup setup = setup_at_limits();
  setup.patterns = kPatterns;
  setup.contrast = 150;  // so that the shares of the face in folded heads are drawn, too
  setup.chroma_contrast = 390;
  std::mt19937 random(2);
  const CodedState seen = seen_in_the_middle(setup);
  const auto pictures = pictures_of(talker_settings(kWidth, kHeight, 24));
  auto av1 = must(PatternEncoder::create(setup.format, 63));
  PatternPacketWriter writer;
  auto pieces = beginning(setup, seen, random, must(av1.encode(pictures[0])), writer);
  MotionEncoder motion(setup, seen);
  BlendEncoder blend;
  std::int32_t next_pattern = 1;
  for (std::int32_t group = 0; group < 2; ++group) {
    pieces.push_back(motion_at_limits(motion, random));
    std::vector<PatternSyntax> patterns(kPatternsAfterMotion);
    for (PatternSyntax& pattern : patterns) {
      pattern.slot = next_pattern < kPatterns ? next_pattern : static_cast<int>(random() % kPatterns);
      pattern.picture = group * kGroupPictures + 1 + static_cast<int>(random() % (kGroupPictures - 1));
      pattern.av1 = must(av1.encode(pictures[next_pattern]));
      ++next_pattern;
    }
    pieces.push_back(
        {PacketType::kPattern, must(writer.encode(patterns, setup, (group + 1) * kGroupPictures))});
    BlendGroup modes;
    modes.key = blend.groups() == 0;
    modes.first = blend.next();
    for (int i = 0; i < kGroupPictures; ++i) modes.modes.push_back(random_modes(random));
    pieces.push_back({PacketType::kBlend, must(blend.encode(modes))});
  }
  return joined(pieces);
}

}  // namespace

void add_limits(Folder& folder) {
  folder.add("limits.fbs", limits_stream(), 40);
  folder.add("blend_limits.fbs", blended_limits_stream(), 40);
}

}  // namespace fbs
