// The packet reader of fbs/packet.h.
#include <memory>
#include <variant>

#include "bitstream/packet.h"
#include "decoder/stream/packet_times.h"
#include "fbs/packet.h"
#include "library/boundary.h"
#include "library/caller_picture.h"

namespace {

using namespace fbs;

static_assert(FBS_MAX_FOUND_PACKET == packet_size(kMaxSearchedPayload));

}  // namespace

struct fbs_packet_reader {  // NOLINT(readability-identifier-naming): the interface is C
  struct Stream {
    PacketReader packets;
    PacketTimes times;
  };
  std::unique_ptr<Stream> stream = std::make_unique<Stream>();  ///< never null
  bool finished = false;
  LastError fault;  ///< of the last packet
  mutable LastError error;
};

fbs_status fbs_packet_reader_open(fbs_packet_reader** out) {
  return open_object(out);
}

void fbs_packet_reader_close(fbs_packet_reader** reader) {
  close_object(reader);
}

fbs_status fbs_packet_reader_feed(fbs_packet_reader* reader, const uint8_t* bytes, size_t size) {
  if (reader == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_packet_reader& r = *reader;
  if (bytes == nullptr && size > 0) return r.error.set_argument(kNullPointer);
  if (r.finished) return r.error.set_argument("bytes after fbs_packet_reader_finish()");
  return guarded(r.error, [&] {
    r.stream->packets.feed({bytes, size});
    return FBS_OK;
  });
}

fbs_status fbs_packet_reader_finish(fbs_packet_reader* reader) {
  if (reader == nullptr) return FBS_ERROR_ARGUMENT;
  if (!reader->finished) reader->stream->packets.close();
  reader->finished = true;
  return FBS_OK;
}

fbs_status fbs_packet_reader_reset(fbs_packet_reader* reader) {
  if (reader == nullptr) return FBS_ERROR_ARGUMENT;
  return guarded(reader->error, [&] {
    reader->stream = std::make_unique<fbs_packet_reader::Stream>();
    reader->finished = false;
    return FBS_OK;
  });
}

fbs_status fbs_packet_reader_next(fbs_packet_reader* reader, fbs_packet_info* info) {
  if (reader == nullptr) return FBS_ERROR_ARGUMENT;
  fbs_packet_reader& r = *reader;
  if (info == nullptr) return r.error.set_argument(kNullPointer);
  return guarded(r.error, [&] {
    auto& [packets, times] = *r.stream;
    auto read = packets.next();
    for (; read && read->packet.in_parts; read = packets.next()) (void)times.take(read->packet);
    if (!read) {
      times.lose();
      const Error& e = read.error();
      return r.error.set(status_of(e.code), e.text.c_str(), e.byte_offset);
    }
    if (read->status != ReadStatus::kPacket)
      return read->status == ReadStatus::kEnd ? FBS_END : FBS_NEED_DATA;
    const Packet& packet = read->packet;
    StreamPosition from = times.released();
    const auto timed = times.take(packet);
    const StreamPosition& until = times.released();
    if (enters_scene(packet.type) || packet.type == PacketType::kEnd) from = until;
    *info = {static_cast<int>(packet.type),
             packet.offset,
             packet.size,
             0,
             from.pictures,
             from.time,
             static_cast<uint32_t>(until.pictures - from.pictures),
             from.time,
             until.time,
             nullptr,
             0};
    if (timed) {
      const bool counts = is_of_scene(packet.type) || packet.type == PacketType::kReturn;
      info->skipped = counts && std::holds_alternative<std::monostate>(timed->syntax) ? 1 : 0;
      info->key = timed->key ? 1 : 0;
      info->number = timed->first.pictures;
      info->time = timed->first.time;
      if (const auto* const head = std::get_if<JoinedHead>(&timed->syntax)) packets.read_head(head->packets);
    } else {
      r.fault.set(timed.error());
      info->fault = r.fault.text();
    }
    return FBS_OK;
  });
}

fbs_status fbs_packet_reader_get_format(const fbs_packet_reader* reader, fbs_format* out) {
  if (reader == nullptr) return FBS_ERROR_ARGUMENT;
  if (out == nullptr) return reader->error.set_argument(kNullPointer);
  const PacketTimes& times = reader->stream->times;
  if (!times.has_setup()) return FBS_NEED_DATA;
  *out = caller_format(times.setup().format);
  return FBS_OK;
}

const char* fbs_packet_reader_error(const fbs_packet_reader* reader) {
  return reader != nullptr ? reader->error.text() : "";
}

uint64_t fbs_packet_reader_error_offset(const fbs_packet_reader* reader) {
  return reader != nullptr ? reader->error.offset() : 0;
}
