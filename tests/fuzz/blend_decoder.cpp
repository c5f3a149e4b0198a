// Bytes to the modes of pictures: all modes are valid, and a group that was read can be written and read
// back.
#include <algorithm>

#include "bitstream/blend/blend_coder.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return payloads_of(stream, PacketType::kBlend);
}

namespace {

bool is_mode(fbs::BlendMode mode) {
  return static_cast<int>(mode) < fbs::kBlendModeCount;
}

fbs::BlendGroup key_group() {
  fbs::BlendGroup group;
  group.key = true;
  group.modes.resize(3);
  return group;
}

void decode(bool begun, std::span<const std::uint8_t> payload) {
  fbs::BlendDecoder reader, again;
  fbs::BlendEncoder writer;
  if (begun) {
    const auto first = *writer.encode(key_group());
    require(reader.decode(first) && again.decode(first), "a key group");
  }
  for (int group = 0; group < 2; ++group) {  // the second is predicted from the first
    const auto read = reader.decode(payload);
    if (!read) {
      require(read.error().code != fbs::ErrorCode::kInternal, "internal error");
      return;
    }
    if (!*read) return;  // skipped
    const fbs::BlendGroup& blend = **read;
    require(!blend.modes.empty() && blend.modes.size() <= fbs::kMaxGroupPictures, "a number of pictures");
    for (const fbs::RegionModes& modes : blend.modes)
      require(std::all_of(modes.begin(), modes.end(), is_mode), "a mode out of range");
    if (blend.missing > 0) return;  // no writer leaves out pictures
    const auto written = writer.encode(blend);
    require(written.has_value(), "a group that was read cannot be written");
    require(**again.decode(*written) == blend, "round trip");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const bool begun : {false, true}) decode(begun, {data, size});
  return 0;
}
