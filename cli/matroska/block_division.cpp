#include "cli/matroska/block_division.h"

#include <algorithm>
#include <optional>

#include "bitstream/packet.h"
#include "bitstream/payload/setup_payload.h"
#include "decoder/stream/packet_times.h"

namespace fbs::cli {
namespace {

class BlockDivision {
 public:
  explicit BlockDivision(std::span<const std::uint8_t> stream) : stream_(stream) {}

  Result<void> take(const Packet& packet) {
    const bool enters = enters_scene(packet.type);
    if (enters) append(packet.offset);
    if (packet.type == PacketType::kSetup)
      if (auto begun = begin_scene(packet); !begun) return begun;
    const StreamPosition before = times_.released();
    (void)times_.take(packet);
    const StreamPosition after = times_.released();
    const std::uint64_t end = packet.offset + packet.size;
    if (after.time > before.time && !enters && packet.type != PacketType::kEnd) {
      add(before.time, after.time, end);
      const std::uint64_t nominal = nominal_duration(out_.setup.format.frame_rate);
      if (after.time - before.time != (after.pictures - before.pictures) * nominal)
        out_.constant_rate = false;
    } else if (packet.type == PacketType::kEnd) {
      append(end);
    }
    return {};
  }

  void lose() { times_.lose(); }

  Result<StreamBlocks> finish() {
    if (!has_setup_)
      return fail(ErrorCode::kTruncated, "has no setup packet: nothing says what its pictures are");
    if (pending_ < stream_.size() && out_.blocks.empty())
      add(out_.setup.before.time, out_.setup.before.time, stream_.size());
    append(stream_.size());
    return std::move(out_);
  }

 private:
  Result<void> begin_scene(const Packet& packet) {
    auto setup = decode_setup(packet.payload);
    if (setup && setup->keeps == SceneKeeping::kNone) joinable_ = static_cast<std::size_t>(packet.offset);
    if (has_setup_) return {};
    if (!setup) return fail(setup.error());
    has_setup_ = true;
    out_.setup = *setup;
    out_.setup_begin = packet.offset;
    out_.setup_end = packet.offset + packet.size;
    return {};
  }

  void add(std::uint64_t time, std::uint64_t until, std::uint64_t end) {
    const bool key = pending_ == joinable_;
    out_.blocks.push_back({time, until - time, key, pending_, static_cast<std::size_t>(end)});
    pending_ = static_cast<std::size_t>(end);
  }

  /// Appends waiting packets, up to `end`, to the last block, if there is one.
  void append(std::uint64_t end) {
    if (out_.blocks.empty()) return;
    StreamBlock& last = out_.blocks.back();
    last.end = pending_ = static_cast<std::size_t>(end);
    last.duration =
        std::max(last.duration, times_.released().time - last.time);  // pictures held at an end packet
  }

  std::span<const std::uint8_t> stream_;
  PacketTimes times_;
  StreamBlocks out_;
  std::size_t pending_ = kSignature.size();  // first byte not yet in a block
  std::size_t joinable_ = 0;                 // where the last scene begins that can be joined
  bool has_setup_ = false;
};

}  // namespace

Result<StreamBlocks> divide_stream(std::span<const std::uint8_t> stream) {
  if (stream.size() < kSignature.size() || !std::ranges::equal(stream.first(kSignature.size()), kSignature))
    return fail(ErrorCode::kNotFbs, "is not an fbs stream");
  PacketReader reader(stream);
  BlockDivision division(stream);
  for (;;) {
    const auto read = reader.next();
    if (!read) {
      division.lose();
      continue;
    }
    if (read->status != ReadStatus::kPacket) return division.finish();
    if (auto taken = division.take(read->packet); !taken) return fail(taken.error());
  }
}

}  // namespace fbs::cli
