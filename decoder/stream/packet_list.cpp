#include "decoder/stream/packet_list.h"

#include <algorithm>
#include <array>
#include <deque>
#include <utility>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/motion/motion_decoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/sound_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/payload/wire_frame_payload.h"
#include "bitstream/sound_time.h"
#include "decoder/stream/stream_clock.h"

namespace fbs {
namespace {

constexpr auto kNames =
    std::to_array<const char*>({"", "setup", "geometry", "surround", "pattern", "motion", "end", "blend",
                                "wire-frame", "sound setup", "sound"});  // by PacketType

std::string name_of(PacketType type) {
  const auto number = static_cast<std::size_t>(type);
  return number > 0 && number < kNames.size() ? kNames[number] : "type " + std::to_string(number);
}

/// Times of the pictures of a scene from the motion packets that have them to the patterns that show them.
class PictureTimes {
 public:
  explicit PictureTimes(std::uint64_t begin) : end_(begin) {}

  [[nodiscard]] std::int32_t count() const { return first_ + static_cast<std::int32_t>(known_.size()); }

  void add(std::uint32_t duration) {
    known_.push_back({end_, duration});
    end_ += duration;
    if (known_.size() <= kMaxWaitingPictures + kKeptPictures) return;
    known_.pop_front();
    ++first_;
  }

  /// Where a picture begins, or the next one would; nothing if it is too old.
  [[nodiscard]] std::optional<std::uint64_t> of(std::int32_t picture) const {
    if (picture == count()) return end_;
    if (picture < first_ || picture > count()) return std::nullopt;
    return known_[picture - first_].begin;
  }

  /// Duration of a picture that has been added and is not too old.
  [[nodiscard]] std::uint32_t duration(std::int32_t picture) const {
    return known_[picture - first_].duration;
  }

 private:
  struct Known {
    std::uint64_t begin;
    std::uint32_t duration;  // 1/90000 s
  };
  std::deque<Known> known_;  // pictures first_, first_ + 1, ...
  std::int32_t first_ = 0;
  std::uint64_t end_;  // of the last
};

/// Reads the payloads of a scene, as StreamDecoder does, but for frames.
class SceneReader {
 public:
  explicit SceneReader(const Setup& setup)
      : setup_(setup), times_(setup.before.time), nominal_(nominal_duration(setup.format.frame_rate)) {}

  [[nodiscard]] std::uint32_t nominal() const { return nominal_; }

  /// Reads one of its packets and fills in key and time.
  /// @param clock  is shown the pictures that the packet releases
  Result<void> take(const Packet& packet, StreamClock& clock, PacketEntry& entry) {
    switch (packet.type) {
      case PacketType::kWireFrame: {
        entry.time = times_.of(released_);
        auto read = decode_wire_frame(packet.payload);
        if (!read) return fail(read.error());
        wire_frame_ = std::move(*read);
        return {};
      }
      case PacketType::kGeometry: {
        entry.time = times_.of(released_);
        const auto read = decode_geometry(packet.payload, wire_frame_);
        return read ? Result<void>{} : fail(read.error());
      }
      case PacketType::kSurround: {
        entry.time = times_.of(released_);
        const auto read = decode_surround(packet.payload);
        return read ? Result<void>{} : fail(read.error());
      }
      case PacketType::kSoundSetup: {
        entry.time = times_.of(released_);
        const auto read = decode_sound_setup(packet.payload);
        sound_ = read.value_or(std::nullopt);
        return read ? Result<void>{} : fail(read.error());
      }
      case PacketType::kSound:
        return take_sound(packet, entry);
      case PacketType::kPattern:
        return take_patterns(packet, entry);
      case PacketType::kMotion:
        return take_motion(packet, clock, entry);
      default:
        return take_blend(packet, clock, entry);
    }
  }

 private:
  Result<void> take_sound(const Packet& packet, PacketEntry& entry) const {
    if (!sound_) return {};
    const auto group = decode_sound(packet.payload, *sound_);
    if (!group) return fail(group.error());
    const std::int64_t begin = frame_time(*sound_, group->first);
    entry.time = begin < 0 ? 0 : static_cast<std::uint64_t>(begin) * kTicksPerSecond / kSoundClock;
    return {};
  }

  Result<void> take_patterns(const Packet& packet, PacketEntry& entry) {
    const auto read = patterns_.decode(packet.payload, setup_, times_.count());
    if (!read) return fail(read.error());
    const PatternSyntax& first = read->front();
    entry.key = first.picture == 0;
    entry.time = times_.of(first.picture);
    if (entry.key == motion_.has_value()) return fail(ErrorCode::kInvalidStream, "a pattern out of order");
    for (const PatternSyntax& pattern : *read) {
      if (pattern.slot > stored_) return fail(ErrorCode::kInvalidStream, "a pattern out of order");
      if (pattern.picture < released_ - kKeptPictures)
        return fail(ErrorCode::kInvalidStream, "a pattern of a picture without a state");
      stored_ = std::max(stored_, pattern.slot + 1);
    }
    if (!entry.key) return {};
    motion_.emplace(setup_, first.state);
    if (setup_.patterns > 1) blend_.emplace();
    return {};
  }

  Result<void> take_motion(const Packet& packet, StreamClock& clock, PacketEntry& entry) {
    if (!motion_) return fail(ErrorCode::kInvalidStream, "motion before the first pattern");
    const auto group = motion_->decode(packet.payload);
    if (!group) return fail(group.error());
    entry.key = group->key;
    entry.time = times_.of(times_.count());
    if (times_.count() - released_ + group->pictures > kMaxWaitingPictures)
      return fail(ErrorCode::kTooLarge, "too many pictures wait for their patterns");
    for (std::int32_t i = 0; i < group->pictures; ++i)
      times_.add(group->durations.empty() ? nominal_ : group->durations[i]);
    if (!blend_) release(times_.count() - released_, clock);
    return {};
  }

  Result<void> take_blend(const Packet& packet, StreamClock& clock, PacketEntry& entry) {
    if (!blend_) return fail(ErrorCode::kInvalidStream, "a blend packet where nothing is blended");
    const auto group = blend_->decode(packet.payload);
    if (!group) return fail(group.error());
    entry.key = group->key;
    entry.time = times_.of(released_);
    const auto pictures = static_cast<std::int32_t>(group->modes.size());
    if (pictures > times_.count() - released_)
      return fail(ErrorCode::kInvalidStream, "a blend packet is ahead of the motion");
    release(pictures, clock);
    return {};
  }

  void release(std::int32_t pictures, StreamClock& clock) {
    for (; pictures > 0; --pictures) clock.show(times_.duration(released_++));
  }

  Setup setup_;
  PictureTimes times_;
  std::uint32_t nominal_;      // duration, 1/90000 s
  std::int32_t released_ = 0;  // pictures
  std::int32_t stored_ = 0;    // slots that are not empty
  PatternPacketReader patterns_;
  std::shared_ptr<const WireFrame> wire_frame_;
  std::optional<SoundSetup> sound_;
  std::optional<MotionDecoder> motion_;
  std::optional<BlendDecoder> blend_;
};

}  // namespace

class PacketLister::Impl {
 public:
  PacketEntry take(const Packet& packet) {
    PacketEntry entry;
    entry.offset = packet.offset;
    entry.bytes = packet.size;
    entry.type = name_of(packet.type);
    if (const auto taken = read(packet, entry); !taken) {
      entry.error = taken.error().text;
      if (!is_sound(packet.type)) lose();
    }
    return entry;
  }

  void lose() {
    clock_.lose();
    scene_.reset();
    lost_ = true;
  }

  [[nodiscard]] const StreamPosition& released() const { return clock_.now(); }

 private:
  Result<void> read(const Packet& packet, PacketEntry& entry) {
    switch (packet.type) {
      case PacketType::kSetup:
        return take_setup(packet, entry);
      case PacketType::kEnd:
        return take_end(packet, entry);
      default:
        break;
    }
    if (static_cast<std::size_t>(packet.type) >= kNames.size() || static_cast<int>(packet.type) == 0)
      return {};
    if (scene_) return scene_->take(packet, clock_, entry);
    if (!lost_) return fail(ErrorCode::kInvalidStream, "a packet before the setup");
    return {};  // the loss has been told of
  }

  Result<void> take_setup(const Packet& packet, PacketEntry& entry) {
    scene_.reset();
    const auto setup = decode_setup(packet.payload);
    if (!setup) return fail(setup.error());
    entry.key = true;
    entry.time = setup->before.time;
    const auto missing = clock_.go_to(setup->before);
    if (!missing) return fail(missing.error());
    note_missing(*missing, entry);
    scene_.emplace(*setup);
    nominal_ = scene_->nominal();
    lost_ = false;
    return {};
  }

  Result<void> take_end(const Packet& packet, PacketEntry& entry) {
    const auto end = decode_end(packet.payload);
    if (!end) return fail(end.error());
    const auto missing = clock_.go_to_end(end->pictures, nominal_);
    if (!missing) return fail(missing.error());
    note_missing(*missing, entry);
    entry.time = clock_.now().time;
    return {};
  }

  /// Pictures that are missing without a damaged packet before.
  void note_missing(std::uint64_t missing, PacketEntry& entry) {
    if (missing > 0 && !lost_)
      entry.error =
          std::to_string(missing) + (missing == 1 ? " picture is missing" : " pictures are missing");
    while (clock_.is_behind()) clock_.hold(nominal_);
  }

  StreamClock clock_;
  std::optional<SceneReader> scene_;
  std::uint32_t nominal_ = 1;  // duration in the last scene, 1/90000 s
  bool lost_ = false;          // something since the last setup packet
};

PacketLister::PacketLister() : impl_(std::make_unique<Impl>()) {}
PacketLister::~PacketLister() = default;
PacketLister::PacketLister(PacketLister&&) noexcept = default;
PacketLister& PacketLister::operator=(PacketLister&&) noexcept = default;

PacketEntry PacketLister::take(const Packet& packet) {
  return impl_->take(packet);
}

void PacketLister::lose() {
  impl_->lose();
}

std::uint64_t PacketLister::released() const {
  return impl_->released().time;
}

std::uint64_t PacketLister::released_pictures() const {
  return impl_->released().pictures;
}

std::vector<PacketEntry> list_packets(std::span<const std::uint8_t> stream) {
  PacketReader reader;
  reader.feed(stream);
  reader.close();
  PacketLister lister;
  std::vector<PacketEntry> entries;
  std::optional<Error> damage;
  for (;;) {
    const auto read = damage ? reader.resync() : reader.next();
    if (!read) {
      damage = read.error();
      lister.lose();
      continue;
    }
    const bool end = read->status != ReadStatus::kPacket;
    if (damage) {
      const std::uint64_t next = end ? stream.size() : read->packet.offset;
      entries.push_back(
          {damage->byte_offset, next - damage->byte_offset, kDamage, false, std::nullopt, damage->text});
      damage.reset();
    }
    if (end) return entries;
    entries.push_back(lister.take(read->packet));
  }
}

}  // namespace fbs
