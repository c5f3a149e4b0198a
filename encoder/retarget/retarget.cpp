#include "encoder/retarget/retarget.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <optional>
#include <utility>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/motion/motion_encoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/track.h"
#include "encoder/retarget/fitted_tracks.h"
#include "encoder/retarget/head_surround.h"
#include "encoder/retarget/motion_transfer.h"

namespace fbs {
namespace {

constexpr std::int32_t kGroupPictures = kMaxGroupPictures;
/// Coarser steps of the expression would part touching lips.
constexpr std::int32_t kMaxControlStep = 16;

/// The largest step up to `wanted` that divides `step`, so that what was coded with it stays exact.
std::int32_t finer_step(std::int32_t step, std::int32_t wanted) {
  std::int32_t parts = 1;
  while (step % parts != 0 || step / parts > wanted) ++parts;
  return step / parts;
}

QuantiserSteps finer_steps(const QuantiserSteps& face, const QuantiserSteps& motion) {
  return {finer_step(face.rotation, motion.rotation), finer_step(face.translation, motion.translation),
          finer_step(face.log_scale, motion.log_scale), finer_step(face.light, motion.light),
          finer_step(face.control, std::min(motion.control, kMaxControlStep))};
}

/// The ground is not moved; all else is blended by states, which is smooth where picking a pattern would not
/// be.
RegionModes modes() {
  RegionModes out{};
  out[static_cast<std::size_t>(Region::kGround)] = BlendMode::kStillBefore;
  return out;
}

double expression_distance(const State& a, const State& b) {
  double sum = 0;
  for (std::size_t c = 0; c < kControlCount; ++c) {
    const glm::dvec2 d(a.control[c] - b.control[c]);
    sum += d.x * d.x + d.y * d.y;
  }
  return sum;
}

/// Writes one scene of the result.
class SceneWriter {
 public:
  SceneWriter(const Setup& setup, const FaceStream& face, std::vector<std::uint8_t>& stream)
      : setup_(setup), face_(face), stream_(stream), first_(first_pattern()), motion_(setup, first_.state) {}

  Result<void> write(std::span<const StateNumbers> pictures, std::span<const std::uint32_t> durations) {
    if (auto begun = write_head(); !begun) return begun;
    if (auto moved = write_motion(pictures, durations); !moved) return moved;
    if (face_.later.empty()) return {};
    if (auto sent = write_patterns(); !sent) return sent;
    return write_blend(pictures.size());
  }

 private:
  /// The same state in finer steps.
  [[nodiscard]] PatternSyntax first_pattern() const {
    PatternSyntax out = face_.first;
    for (std::size_t i = 0; i < kParameterCount; ++i)
      out.state[i] = out.state[i] * step_of(face_.setup.steps, i) / step_of(setup_.steps, i);
    return out;
  }

  void add(PacketType type, std::span<const std::uint8_t> payload) { packets_.write(stream_, type, payload); }

  Result<void> write_head() {
    const auto setup = encode_setup(setup_);
    if (!setup) return fail(setup.error());
    const auto pattern = pattern_packets_.encode({&first_, 1}, setup_, 0);
    if (!pattern) return fail(pattern.error());
    std::optional<std::vector<std::uint8_t>> surround;
    if (face_.surround) {
      auto map = encode_surround(with_hair(*face_.surround, setup_.format, face_.rest));
      if (!map) return fail(map.error());
      surround = std::move(*map);
    }
    add(PacketType::kSetup, *setup);
    if (!face_.wire_frame_payload.empty()) add(PacketType::kWireFrame, face_.wire_frame_payload);
    add(PacketType::kGeometry, face_.geometry_payload);
    if (surround) add(PacketType::kSurround, *surround);
    add(PacketType::kPattern, *pattern);
    return {};
  }

  Result<void> write_group(std::span<const StateNumbers> pictures, std::span<const std::uint32_t> durations) {
    MotionGroup group = fitted_tracks(pictures, motion_.anchor(), setup_);
    group.key = motion_.groups() == 0;
    group.first = motion_.next();
    if (std::ranges::any_of(durations,
                            [&](auto d) { return d != nominal_duration(setup_.format.frame_rate); }))
      group.durations.assign(durations.begin(), durations.end());
    const auto payload = motion_.encode(group);
    if (!payload) return fail(payload.error());
    add(PacketType::kMotion, *payload);
    pictures_ += group.pictures;
    return {};
  }

  Result<void> write_motion(std::span<const StateNumbers> pictures,
                            std::span<const std::uint32_t> durations) {
    for (std::size_t done = 0; done < pictures.size(); done += kGroupPictures) {
      const std::size_t count = std::min<std::size_t>(kGroupPictures, pictures.size() - done);
      if (auto written = write_group(pictures.subspan(done, count), durations.subspan(done, count)); !written)
        return written;
    }
    return {};
  }

  /// States of the patterns, as pictures that are never shown. The pattern nearest to the face at rest comes
  /// first: for all shown pictures it is the next one in time.
  Result<void> write_patterns() {
    std::vector<std::size_t> order(face_.later.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(
        order, {}, [&](std::size_t k) { return expression_distance(face_.later[k].seen, face_.rest); });
    std::vector<StateNumbers> seen(order.size());
    std::vector<PatternSyntax> patterns(order.size());
    for (std::size_t place = 0; place < order.size(); ++place) {
      const std::size_t k = order[place];
      seen[place] = numbers_of(face_.later[k].seen);
      patterns[k] = {static_cast<std::int32_t>(k) + 1,
                     pictures_ + static_cast<std::int32_t>(place),
                     {},
                     face_.later[k].av1};
    }
    if (auto written = write_group(seen, {}); !written) return written;
    for (std::size_t begin = 0, end = 0; begin < patterns.size(); begin = end) {
      std::size_t bytes = patterns[end++].av1.size();
      while (end < patterns.size() && (bytes += patterns[end].av1.size()) <= kMaxPatternsTogether) ++end;
      const auto payload =
          pattern_packets_.encode(std::span(patterns).subspan(begin, end - begin), setup_, pictures_);
      if (!payload) return fail(payload.error());
      add(PacketType::kPattern, *payload);
    }
    return {};
  }

  Result<void> write_blend(std::size_t pictures) {
    BlendEncoder blend;
    for (std::size_t done = 0; done < pictures; done += kGroupPictures) {
      BlendGroup group{.key = blend.groups() == 0, .first = blend.next(), .missing = 0, .modes = {}};
      group.modes.assign(std::min<std::size_t>(kGroupPictures, pictures - done), modes());
      const auto payload = blend.encode(group);
      if (!payload) return fail(payload.error());
      add(PacketType::kBlend, *payload);
    }
    return {};
  }

  const Setup& setup_;
  const FaceStream& face_;
  std::vector<std::uint8_t>& stream_;
  PatternSyntax first_;
  PacketWriter packets_;
  PatternPacketWriter pattern_packets_;
  MotionEncoder motion_;
  std::int32_t pictures_ = 0;  ///< pictures with a state
};

Setup setup_of(const MotionRecord& motion, const FaceStream& face) {
  Setup setup = face.setup;
  setup.before = {};
  setup.format.frame_rate = motion.frame_rate;
  setup.steps = finer_steps(face.setup.steps, motion.steps);
  setup.parts = static_cast<PartMask>(face.setup.parts | motion.parts);
  setup.patterns = static_cast<std::int32_t>(face.later.size()) + 1;
  return setup;
}

}  // namespace

Result<std::vector<std::uint8_t>> retarget(const MotionRecord& motion, const FaceStream& face) {
  const MotionTransfer transfer(motion, face);
  std::vector<StateNumbers> pictures;
  std::vector<std::uint32_t> durations;
  for (const MotionRecord::Entry& picture : motion.pictures) {
    pictures.push_back(transfer(picture));
    durations.push_back(picture.duration);
  }
  std::vector<std::uint8_t> stream;
  write_signature(stream);
  Setup setup = setup_of(motion, face);
  const std::size_t most = face.later.empty()
                               ? pictures.size()
                               : static_cast<std::size_t>(kMaxWaitingPictures) - face.later.size();
  for (std::size_t done = 0; done < pictures.size(); done += most) {
    const std::size_t count = std::min(most, pictures.size() - done);
    const auto part = std::span(durations).subspan(done, count);
    if (auto written = SceneWriter(setup, face, stream).write(std::span(pictures).subspan(done, count), part);
        !written)
      return fail(written.error());
    for (const std::uint32_t duration : part) setup.before.add(duration);
  }
  PacketWriter().write(stream, PacketType::kEnd, encode_end({pictures.size()}));
  return stream;
}

}  // namespace fbs
