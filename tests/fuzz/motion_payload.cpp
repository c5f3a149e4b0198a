// Bytes to states: what decodes is within the limits, and coded again it decodes to the same.
#include "bitstream/motion_payload.h"

#include "tests/fuzz/fuzz_target.h"

const std::uint8_t kSeedPacket = static_cast<std::uint8_t>(fbs::PacketType::kMotion);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const fbs::FeatureMask features : {0x000, 0x00D, 0x03F, 0x3FF}) {
    fbs::Setup setup;
    setup.format.width = setup.format.height = 64;
    setup.steps = {40, 16, 8, 64};
    setup.features = features;
    fbs::MotionCoder reader(setup), writer(setup), again(setup);
    for (int group = 0; group < 2; ++group) {  // the second as it follows the first
      const auto read = reader.decode({data, size});
      if (!read) {
        require(read.error().code != fbs::ErrorCode::kInternal, "internal error");
        break;
      }
      for (const fbs::State& s : read->states)
        require(reader.limits().hold(fbs::flatten(s)), "a state beyond its limits");
      const auto written = writer.encode(*read);
      require(written.has_value(), "a group that was read cannot be written");
      require(*again.decode(*written) == *read, "round trip");
    }
  }
  return 0;
}
