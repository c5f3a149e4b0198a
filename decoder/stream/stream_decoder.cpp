#include "decoder/stream/stream_decoder.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/sound_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/payload/wire_frame_payload.h"
#include "bitstream/track.h"

namespace fbs {
namespace {

constexpr const char* kNoPicture = "no picture has been decoded yet";

/// Adds where in the stream the packet began.
tl::unexpected<Error> at(const Packet& packet, Error error) {
  error.byte_offset = packet.offset;
  return fail(std::move(error));
}

}  // namespace

std::size_t memory_of(const std::vector<std::uint8_t>& frame) {
  constexpr std::size_t kOverhead = 64;  // of the vector and of what the allocator adds
  return kOverhead + frame.size();
}

std::size_t memory_of(const SoundGroup& group) {
  std::size_t sum = 0;
  for (const auto& frame : group.frames) sum += memory_of(frame);
  return sum;
}

StreamDecoder::StreamDecoder() {
  bytes_.other = bytes_.total = kSignature.size();
}

void StreamDecoder::feed(std::span<const std::uint8_t> bytes) {
  reader_.feed(bytes);
}

void StreamDecoder::close() {
  reader_.close();
}

Result<DecodeStatus> StreamDecoder::next() {
  for (;;) {
    if (timeline_.has_next()) return show(timeline_.next());
    if (clock_.is_behind()) return hold();
    if (next_scene_) begin_scene();
    auto read = damaged_ ? reader_.resync() : reader_.next();
    if (!read) {
      damaged_ = true;
      // Without a signature the stream is joined in its middle: nothing of it is known to be lost.
      if (read.error().code == ErrorCode::kNotFbs)
        lost_ = true;
      else
        lose();
      return fail(read.error());
    }
    if (read->status == ReadStatus::kNeedMore) return DecodeStatus::kNeedMore;
    if (read->status == ReadStatus::kEnd) {
      if (!has_setup_ && !lost_ && !std::exchange(missing_setup_reported_, true))
        return fail(ErrorCode::kTruncated, "the stream ends before its setup", reader_.offset());
      return DecodeStatus::kEnd;
    }
    damaged_ = false;
    count(read->packet);
    if (auto taken = take(read->packet); !taken) return fail(taken.error());
  }
}

DecodeStatus StreamDecoder::show(const Timeline::Entry& picture) {
  state_ = picture.state;
  shown_scene_.reset();
  kept_.reset();
  store_arrivals();
  position_ = clock_.now();
  duration_ = picture.duration;
  held_ = false;
  clock_.show(duration_);
  ++pictures_;
  return DecodeStatus::kPicture;
}

DecodeStatus StreamDecoder::hold() {
  position_ = clock_.now();
  duration_ = clock_.hold(nominal_duration(format().frame_rate));
  held_ = true;
  ++pictures_;
  return DecodeStatus::kPicture;
}

Result<void> StreamDecoder::render(Picture& out) {
  if (pictures_ == 0) return fail(ErrorCode::kInvalidArgument, kNoPicture);
  return renderer_.render(kept_ ? *kept_ : scene(), state_, out);
}

Result<void> StreamDecoder::render(const PictureView& out) {
  if (pictures_ == 0) return fail(ErrorCode::kInvalidArgument, kNoPicture);
  return renderer_.render(kept_ ? *kept_ : scene(), state_, out);
}

Result<void> StreamDecoder::render_state(const State& state, std::optional<std::size_t> pattern,
                                         Picture& out) {
  if (pictures_ == 0 || kept_) return render(out);
  return pattern ? renderer_.render_from(*pattern, scene(), state, out)
                 : renderer_.render(scene(), state, out);
}

Result<void> StreamDecoder::render_state(const State& state, const PictureView& out) {
  if (pictures_ == 0 || kept_) return render(out);
  return renderer_.render(scene(), state, out);
}

void StreamDecoder::count(const Packet& packet) {
  // Count skipped bytes as other.
  bytes_.other += packet.offset - bytes_.total;
  bytes_.total = packet.offset + packet.size;
  switch (packet.type) {
    case PacketType::kWireFrame:
    case PacketType::kGeometry:
    case PacketType::kSurround:
      bytes_.geometry += packet.size;
      break;
    case PacketType::kPattern:
      bytes_.patterns += packet.size;
      break;
    case PacketType::kMotion:
      bytes_.motion += packet.size;
      break;
    case PacketType::kBlend:
      bytes_.motion += packet.size;
      bytes_.blend += packet.size;
      break;
    case PacketType::kSoundSetup:
    case PacketType::kSound:
      bytes_.sound += packet.size;
      break;
    default:
      bytes_.other += packet.size;
      break;
  }
}

Result<void> StreamDecoder::take(const Packet& packet) {
  switch (packet.type) {
    case PacketType::kSetup:
      return take_setup(packet);
    case PacketType::kEnd:
      return take_end(packet);
    case PacketType::kWireFrame:
    case PacketType::kGeometry:
    case PacketType::kSurround:
    case PacketType::kPattern:
    case PacketType::kMotion:
    case PacketType::kBlend: {
      if (lost_) return {};  // SPEC 6.2
      auto taken = take_of_scene(packet);
      if (!taken) lose();
      return taken;
    }
    case PacketType::kSoundSetup:
      return lost_ ? Result<void>() : take_sound_setup(packet);
    case PacketType::kSound:
      return lost_ ? Result<void>() : take_sound(packet);
  }
  return {};  // SPEC 3.1: skipped
}

void StreamDecoder::lose() {
  clock_.lose();
  lost_ = true;
}

// SPEC 6.1
Result<void> StreamDecoder::take_setup(const Packet& packet) {
  const bool reported = lost_;
  lost_ = true;  // until the scene begins
  auto setup = decode_setup(packet.payload);
  if (!setup) return at(packet, setup.error());
  if (has_setup_ && (setup->format.width != format().width || setup->format.height != format().height))
    return fail(ErrorCode::kUnsupported, "the picture size changes inside the stream", packet.offset);
  const auto pixels =
      static_cast<std::uint64_t>(setup->format.width) * static_cast<std::uint64_t>(setup->format.height);
  if (max_pixels_ && pixels > *max_pixels_)
    return fail(ErrorCode::kTooLarge, "the picture has more pixels than are allowed", packet.offset);
  auto patterns = PatternDecoder::create(setup->format.width, setup->format.height);
  if (!patterns) return at(packet, patterns.error());
  const auto missing = clock_.go_to(setup->before);
  if (!missing) return at(packet, missing.error());
  next_scene_.emplace(NextScene{*setup, std::move(*patterns)});
  return report_missing(*missing, reported, packet);
}

// SPEC 4.7
Result<void> StreamDecoder::take_end(const Packet& packet) {
  const auto end = decode_end(packet.payload);
  if (!end) return at(packet, end.error());
  announced_ = end->pictures;
  const std::uint32_t nominal = has_setup_ ? nominal_duration(format().frame_rate) : 1;
  const auto missing = clock_.go_to_end(end->pictures, nominal);
  if (!missing) return at(packet, missing.error());
  return report_missing(*missing, lost_, packet);
}

Result<void> StreamDecoder::report_missing(std::uint64_t missing, bool reported, const Packet& packet) const {
  const bool left_out = missing > 0 && pictures_ > 0 && !clock_.is_behind();
  if (missing == 0 || (reported && !left_out)) return {};
  const std::string text =
      std::to_string(missing) + (missing == 1 ? " picture is" : " pictures are") + " missing";
  if (left_out) return fail(ErrorCode::kTooLarge, text + ", too many to be held", packet.offset);
  return fail(ErrorCode::kInvalidStream, text, packet.offset);
}

void StreamDecoder::begin_scene() {
  const bool shown = pictures_ > 0 && !shown_scene_;
  if (shown) shown_scene_ = std::move(scene_);
  scene_ = Scene{next_scene_->setup, std::nullopt, {}};
  arrivals_.clear();
  slots_ = 0;
  patterns_.emplace(std::move(next_scene_->patterns));
  next_scene_.reset();
  pattern_packets_ = {};
  motion_.reset();
  blend_.reset();
  timeline_ = {};
  lost_ = false;
  bit_counter_.reset();
  wire_frame_.reset();
  sound_.reset();
  geometry_.reset();
  surround_ = still_surround();
  has_setup_ = true;
}

Result<void> StreamDecoder::take_of_scene(const Packet& packet) {
  if (!has_setup_) return fail(ErrorCode::kInvalidStream, "a packet before the setup", packet.offset);
  switch (packet.type) {
    case PacketType::kGeometry: {
      auto geometry = decode_geometry(packet.payload, wire_frame_);
      if (!geometry) return at(packet, geometry.error());
      if (scene_.patterns.empty()) geometry_ = *geometry;
      return {};
    }
    case PacketType::kWireFrame: {
      auto frame = decode_wire_frame(packet.payload);
      if (!frame) return at(packet, frame.error());
      wire_frame_ = std::move(*frame);
      return {};
    }
    case PacketType::kSurround:
      return take_surround(packet);
    case PacketType::kPattern:
      return take_patterns(packet);
    case PacketType::kBlend:
      return take_blend(packet);
    default:
      return take_motion(packet);
  }
}

// SPEC 6.3: what is wrong with sound does no harm to pictures.
Result<void> StreamDecoder::take_sound_setup(const Packet& packet) {
  sound_.reset();
  if (!has_setup_) return fail(ErrorCode::kInvalidStream, "a packet before the setup", packet.offset);
  const auto setup = decode_sound_setup(packet.payload);
  if (!setup) return at(packet, setup.error());
  sound_ = *setup;
  return {};
}

Result<void> StreamDecoder::take_sound(const Packet& packet) {
  if (!sound_) return {};
  auto group = decode_sound(packet.payload, *sound_);
  if (!group) return at(packet, group.error());
  if (group->first < next_sound_)
    return fail(ErrorCode::kInvalidStream, "sound comes out of order", packet.offset);
  next_sound_ = group->first + static_cast<std::int64_t>(group->frames.size());
  if (!keeps_sound_) return {};
  const std::size_t size = memory_of(*group);
  if (sound_size_ + size > kMaxSoundAhead)
    return fail(ErrorCode::kTooLarge, "too much sound comes before its pictures", packet.offset);
  sound_size_ += size;
  sound_parts_.push_back({*sound_, std::move(*group)});
  return {};
}

Result<void> StreamDecoder::keep_picture() {
  if (pictures_ == 0 || shown_scene_ || kept_) return {};
  Picture picture;
  if (auto drawn = render(picture); !drawn) return drawn;
  kept_ = Scene{scene_.setup, std::nullopt, {}};
  kept_->patterns.push_back(make_pattern(std::move(picture), state_, std::nullopt));
  return {};
}

Result<void> StreamDecoder::store(std::size_t slot, Pattern pattern) {
  slots_ = std::max(slots_, slot + 1);
  const bool waits = pictures_ > 0 && !shown_scene_ && !kept_;
  if (waits && arrivals_.size() == kMaxArrivals)
    if (auto kept = keep_picture(); !kept) return kept;
  arrivals_.push_back({slot, std::move(pattern)});
  if (!waits || kept_) store_arrivals();
  return {};
}

void StreamDecoder::store_arrivals() {
  for (Arrival& a : arrivals_) {
    if (a.slot < scene_.patterns.size())
      scene_.patterns[a.slot] = std::move(a.pattern);
    else
      scene_.patterns.push_back(std::move(a.pattern));
  }
  arrivals_.clear();
}

void StreamDecoder::begin_geometry() {
  if (geometry_) scene_.set_geometry({scene_.setup, *geometry_, surround_, rest_});
}

Result<void> StreamDecoder::take_surround(const Packet& packet) {
  auto surround = decode_surround(packet.payload);
  if (!surround) return at(packet, surround.error());
  surround_ = std::move(*surround);
  if (!scene_.geometry) return {};
  if (auto kept = keep_picture(); !kept) return kept;
  store_arrivals();
  begin_geometry();
  return {};
}

Result<void> StreamDecoder::take_patterns(const Packet& packet) {
  const auto patterns = pattern_packets_.decode(packet.payload, scene_.setup, timeline_.end());
  if (!patterns) return at(packet, patterns.error());
  std::vector<bool> reduced;
  for (const PatternSyntax& pattern : *patterns) {
    const auto taken = take_pattern(pattern);
    if (!taken) return at(packet, taken.error());
    reduced.push_back(*taken);
  }
  if (records_patterns_) record(packet, *patterns, reduced);
  return {};
}

Result<bool> StreamDecoder::take_pattern(const PatternSyntax& pattern) {
  const bool first = slots_ == 0;
  if (first != (pattern.picture == 0) || pattern.slot > static_cast<int>(slots_))
    return fail(ErrorCode::kInvalidStream, "a pattern out of order");
  const State* known = first ? nullptr : timeline_.find(pattern.picture);
  if (!first && known == nullptr)
    return fail(ErrorCode::kInvalidStream, "a pattern of a picture without a state");
  auto frame = patterns_->decode_frame(pattern.av1);
  if (!frame) return fail(frame.error());
  const State seen = first ? state_of(pattern.state, scene_.setup.steps) : *known;
  if (first) {
    rest_ = seen;
    begin_geometry();
    motion_.emplace(scene_.setup, pattern.state);
    if (scene_.setup.patterns > 1) blend_.emplace();
    if (counts_motion_bits_) bit_counter_.emplace(scene_.setup, pattern.state);
  }
  Pattern made = make_coded_pattern(std::move(frame->picture), seen, scene_.geometry, scene_.setup);
  if (auto stored = store(static_cast<std::size_t>(pattern.slot), std::move(made)); !stored)
    return fail(stored.error());
  return frame->reduced;
}

void StreamDecoder::record(const Packet& packet, std::span<const PatternSyntax> patterns,
                           const std::vector<bool>& reduced) {
  std::uint64_t frames = 0, frames_before = 0;
  for (const PatternSyntax& pattern : patterns) frames += pattern.av1.size();
  const auto share = [&](std::uint64_t bytes) { return packet.size * bytes / frames; };
  for (std::size_t k = 0; k < patterns.size(); ++k) {
    const std::uint64_t frames_after = frames_before + patterns[k].av1.size();
    pattern_records_.push_back(
        {patterns[k].slot, scene_.setup.before.pictures + static_cast<std::uint64_t>(patterns[k].picture),
         share(frames_after) - share(frames_before), reduced[k]});
    frames_before = frames_after;
  }
}

Result<void> StreamDecoder::take_motion(const Packet& packet) {
  if (scene_.patterns.empty())
    return fail(ErrorCode::kInvalidStream, "motion before the first pattern", packet.offset);
  auto group = motion_->decode(packet.payload);
  if (!group) return at(packet, group.error());
  if (bit_counter_) {
    const PartBitsX256 bits = bit_counter_->count(*group);
    std::transform(bits.begin(), bits.end(), motion_bits_.begin(), motion_bits_.begin(), std::plus<>());
  }
  std::vector<State> states = states_of(*group, scene_.setup.steps);
  if (group->durations.empty())
    group->durations.assign(states.size(), nominal_duration(scene_.setup.format.frame_rate));
  if (auto added = timeline_.add(states, group->durations); !added) return at(packet, added.error());
  if (!blend_) timeline_.release_all();
  note_startup();
  return {};
}

Result<void> StreamDecoder::take_blend(const Packet& packet) {
  if (!blend_)
    return fail(ErrorCode::kInvalidStream, "a blend packet where nothing is blended", packet.offset);
  auto group = blend_->decode(packet.payload);
  if (!group) return at(packet, group.error());
  if (auto released = timeline_.release(group->modes); !released) return at(packet, released.error());
  note_startup();
  return {};
}

void StreamDecoder::note_startup() {
  if (bytes_.startup == 0 && timeline_.has_next()) bytes_.startup = bytes_.total;
}

}  // namespace fbs
