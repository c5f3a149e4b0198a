// Bytes to a wire-frame: it follows the rules, and one that was read can be written and read back.
#include "bitstream/payload/wire_frame_payload.h"

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/seeds.h"

std::vector<fbs::fuzz::Bytes> fbs::fuzz::seeds_of(const Bytes& stream) {
  return payloads_of(stream, PacketType::kWireFrame);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto frame = fbs::decode_wire_frame({data, size});
  if (!frame) {
    require(frame.error().code != fbs::ErrorCode::kInternal, "internal error");
    return 0;
  }
  const fbs::WireFrameTables tables = fbs::tables_of(**frame);
  require(fbs::make_wire_frame(tables).has_value(), "a wire-frame that breaks a rule");
  const auto written = fbs::encode_wire_frame(**frame);
  require(written.has_value(), "a wire-frame that was read cannot be written");
  const auto again = fbs::decode_wire_frame(*written);
  require(again.has_value() && fbs::tables_of(**again) == tables, "round trip");
  return 0;
}
