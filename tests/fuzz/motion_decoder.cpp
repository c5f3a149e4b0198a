// Bytes to groups of pictures: all numbers are within their limits, and a group that was read can be written
// and read back.
#include "bitstream/motion/motion_decoder.h"

#include "bitstream/motion/motion_encoder.h"
#include "bitstream/track.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return payloads_of(stream, PacketType::kMotion);
}

namespace {

/// One picture at rest, for a group that is not key to follow.
fbs::MotionGroup held_key_group(fbs::PartMask parts) {
  fbs::MotionGroup group;
  group.key = true;
  group.pictures = 1;
  for (std::size_t part = 0; part < fbs::kPartCount; ++part)
    if (fbs::has_part(parts, part)) group.tracks[part].push_back({});
  return group;
}

void decode(fbs::PartMask parts, bool begun, std::span<const std::uint8_t> payload) {
  fbs::Setup setup;
  setup.format.width = setup.format.height = 64;
  setup.steps = {40, 16, 8, 16, 64};
  setup.parts = parts;
  const fbs::CodedState seen{};
  fbs::MotionDecoder reader(setup, seen), again(setup, seen);
  fbs::MotionEncoder writer(setup, seen);
  if (begun) {
    const auto first = *writer.encode(held_key_group(parts));
    require(reader.decode(first) && again.decode(first), "a key group");
  }
  for (int group = 0; group < 2; ++group) {  // the second is predicted from the first
    const auto read = reader.decode(payload);
    if (!read) {
      require(read.error().code != fbs::ErrorCode::kInternal, "internal error");
      return;
    }
    if (!*read) return;  // skipped
    const fbs::MotionGroup& motion = **read;
    require(writer.limits().hold(fbs::last_of(motion)), "a number out of range");
    require(std::cmp_equal(fbs::states_of(motion, setup.steps).size(), motion.missing + motion.pictures),
            "not a state for each picture");
    if (motion.missing > 0) return;  // no writer leaves out pictures
    const auto written = writer.encode(motion);
    require(written.has_value(), "a group that was read cannot be written");
    require(**again.decode(*written) == motion, "round trip");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const fbs::PartMask parts : {0x001, 0x03D, 0x0FF, 0x3FF})
    for (const bool begun : {false, true}) decode(parts, begun, {data, size});
  return 0;
}
