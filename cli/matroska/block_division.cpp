#include "cli/matroska/block_division.h"

#include <algorithm>
#include <optional>

#include "bitstream/packet.h"
#include "bitstream/payload/setup_payload.h"
#include "decoder/stream/packet_list.h"

namespace fbs::cli {
namespace {

class BlockDivision {
 public:
  explicit BlockDivision(std::span<const std::uint8_t> stream) : stream_(stream) {}

  Result<void> take(const Packet& packet) {
    if (packet.type == PacketType::kSetup)
      if (auto begun = begin_scene(packet); !begun) return begun;
    const std::uint64_t before = lister_.released(), pictures = lister_.released_pictures();
    lister_.take(packet);
    const std::uint64_t after = lister_.released(), end = packet.offset + packet.size;
    const bool jumps = packet.type == PacketType::kSetup || packet.type == PacketType::kEnd;
    if (after > before && !jumps) {
      add(before, after, end);
      const std::uint64_t nominal = nominal_duration(out_.setup.format.frame_rate);
      if (after - before != (lister_.released_pictures() - pictures) * nominal) out_.constant_rate = false;
    } else if (packet.type == PacketType::kEnd) {
      append(end);
    }
    return {};
  }

  void lose() { lister_.lose(); }

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
    append(packet.offset);
    if (has_setup_) return {};
    auto setup = decode_setup(packet.payload);
    if (!setup) return fail(setup.error());
    has_setup_ = true;
    out_.setup = *setup;
    out_.setup_begin = packet.offset;
    out_.setup_end = packet.offset + packet.size;
    return {};
  }

  void add(std::uint64_t time, std::uint64_t until, std::uint64_t end) {
    const bool key = stream_[pending_] == static_cast<std::uint8_t>(PacketType::kSetup);
    out_.blocks.push_back({time, until - time, key, pending_, static_cast<std::size_t>(end)});
    pending_ = static_cast<std::size_t>(end);
  }

  /// Appends waiting packets, up to `end`, to the last block, if there is one.
  void append(std::uint64_t end) {
    if (out_.blocks.empty()) return;
    StreamBlock& last = out_.blocks.back();
    last.end = pending_ = static_cast<std::size_t>(end);
    last.duration =
        std::max(last.duration, lister_.released() - last.time);  // pictures held at an end packet
  }

  std::span<const std::uint8_t> stream_;
  PacketLister lister_;
  StreamBlocks out_;
  std::size_t pending_ = kSignature.size();  // first byte not yet in a block
  bool has_setup_ = false;
};

}  // namespace

Result<StreamBlocks> divide_stream(std::span<const std::uint8_t> stream) {
  if (stream.size() < kSignature.size() || !std::ranges::equal(stream.first(kSignature.size()), kSignature))
    return fail(ErrorCode::kNotFbs, "is not an fbs stream");
  PacketReader reader;
  reader.feed(stream);
  reader.close();
  BlockDivision division(stream);
  bool damaged = false;
  for (;;) {
    const auto read = damaged ? reader.resync() : reader.next();
    damaged = !read;
    if (damaged) {
      division.lose();
      continue;
    }
    if (read->status != ReadStatus::kPacket) return division.finish();
    if (auto taken = division.take(read->packet); !taken) return fail(taken.error());
  }
}

}  // namespace fbs::cli
