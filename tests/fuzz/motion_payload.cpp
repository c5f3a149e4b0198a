// Bytes to states: what decodes is within the limits, and coded again it decodes to the same.
#include "bitstream/payload/motion_payload.h"

#include "bitstream/track.h"
#include "tests/fuzz/fuzz_target.h"

const std::uint8_t kSeedPacket = static_cast<std::uint8_t>(fbs::PacketType::kMotion);

namespace {

/// A picture in which nothing moves: what a group that is not key may follow.
fbs::MotionGroup held_key_group(fbs::PartMask parts) {
  fbs::MotionGroup group;
  group.key = true;
  group.pictures = 1;
  for (std::size_t part = 0; part < fbs::kPartCount; ++part)
    if ((parts >> part & 1) != 0) group.tracks[part].push_back({});
  return group;
}

void decode(fbs::PartMask parts, bool begun, std::span<const std::uint8_t> payload) {
  fbs::Setup setup;
  setup.format.width = setup.format.height = 64;
  setup.steps = {40, 16, 8, 16, 64};
  setup.parts = parts;
  const fbs::CodedState seen{};
  fbs::MotionCoder reader(setup, seen), writer(setup, seen), again(setup, seen);
  if (begun) {
    const auto first = *writer.encode(held_key_group(parts));
    require(reader.decode(first) && again.decode(first), "a key group");
  }
  for (int group = 0; group < 2; ++group) {  // the second as it follows the first
    const auto read = reader.decode(payload);
    if (!read) {
      require(read.error().code != fbs::ErrorCode::kInternal, "internal error");
      return;
    }
    require(reader.limits().hold(fbs::last_of(*read)), "a state beyond its limits");
    require(fbs::states_of(*read, setup.steps).size() == static_cast<std::size_t>(read->pictures),
            "states of other pictures");
    const auto written = writer.encode(*read);
    require(written.has_value(), "a group that was read cannot be written");
    require(*again.decode(*written) == *read, "round trip");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const fbs::PartMask parts : {0x001, 0x03D, 0x0FF, 0x3FF})
    for (const bool begun : {false, true}) decode(parts, begun, {data, size});
  return 0;
}
