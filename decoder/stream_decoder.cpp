#include "decoder/stream_decoder.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "bitstream/payload/end_payload.h"
#include "bitstream/payload/geometry_payload.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "bitstream/track.h"

namespace fbs {
namespace {

constexpr const char* kNoPicture = "no picture of the current scene has been decoded yet";

/// Adds where in the stream the packet began.
tl::unexpected<Error> at(const Packet& packet, Error error) {
  error.byte_offset = packet.offset;
  return fail(std::move(error));
}

}  // namespace

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
  while (!timeline_.has_next()) {
    auto read = damaged_ ? reader_.resync() : reader_.next();
    if (!read) {
      damaged_ = true;
      lose();
      return fail(read.error());
    }
    if (read->status == ReadStatus::kNeedMore) return DecodeStatus::kNeedMore;
    if (read->status == ReadStatus::kEnd) {
      if (!has_setup_ && !damaged_ && !std::exchange(missing_setup_reported_, true))
        return fail(ErrorCode::kTruncated, "the stream ends before its setup", reader_.offset());
      return DecodeStatus::kEnd;
    }
    damaged_ = false;
    count(read->packet);
    if (auto taken = take(read->packet); !taken) return fail(taken.error());
  }
  const Timeline::Entry picture = timeline_.next();
  state_ = picture.state;
  duration_ = picture.duration;
  ++pictures_;
  announced_picture_ = true;
  return DecodeStatus::kPicture;
}

Result<void> StreamDecoder::render(Picture& out) {
  if (!announced_picture_) return fail(ErrorCode::kInvalidArgument, kNoPicture);
  return renderer_.render(scene_, state_, out);
}

Result<void> StreamDecoder::render(const PictureView& out) {
  if (!announced_picture_) return fail(ErrorCode::kInvalidArgument, kNoPicture);
  return renderer_.render(scene_, state_, out);
}

void StreamDecoder::count(const Packet& packet) {
  // Count skipped bytes as other.
  bytes_.other += packet.offset - bytes_.total;
  bytes_.total = packet.offset + packet.size;
  switch (packet.type) {
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
    default:
      bytes_.other += packet.size;
      break;
  }
}

Result<void> StreamDecoder::take(const Packet& packet) {
  if (packet.type == PacketType::kSetup) return take_setup(packet);
  if (packet.type == PacketType::kEnd) {
    auto end = decode_end(packet.payload);
    if (!end) return at(packet, end.error());
    announced_ = end->pictures;
    return {};
  }
  const bool known = packet.type == PacketType::kGeometry || packet.type == PacketType::kSurround ||
                     packet.type == PacketType::kPattern || packet.type == PacketType::kMotion ||
                     packet.type == PacketType::kBlend;
  if (!known) return {};  // SPEC 3.1: skipped
  if (!has_setup_) return fail(ErrorCode::kInvalidStream, "a packet before the setup", packet.offset);
  switch (packet.type) {
    case PacketType::kGeometry: {
      auto geometry = decode_geometry(packet.payload);
      if (!geometry) return at(packet, geometry.error());
      geometry_ = *geometry;
      return {};
    }
    case PacketType::kSurround: {
      auto surround = decode_surround(packet.payload);
      if (!surround) return at(packet, surround.error());
      surround_ = std::move(*surround);
      return {};
    }
    default: {
      auto taken = take_dependent(packet);
      if (!taken) lose();
      return taken;
    }
  }
}

void StreamDecoder::lose() {
  if (scene_.patterns.empty()) return;
  motion_->lose();
  lost_ = true;
}

Result<void> StreamDecoder::take_dependent(const Packet& packet) {
  // SPEC 6: numbers of pictures, and frames that patterns refer to, are unknown after a loss.
  if (lost_ && (packet.type == PacketType::kPattern || scene_.setup.patterns > 1))
    return fail(ErrorCode::kInvalidStream, "a packet depends on a missing one", packet.offset);
  if (packet.type == PacketType::kPattern) return take_patterns(packet);
  if (packet.type == PacketType::kBlend) return take_blend(packet);
  return take_motion(packet);
}

Result<void> StreamDecoder::take_setup(const Packet& packet) {
  auto setup = decode_setup(packet.payload);
  if (!setup) return at(packet, setup.error());
  if (has_setup_ && (setup->format.width != format().width || setup->format.height != format().height))
    return fail(ErrorCode::kUnsupported, "the picture size changes inside the stream", packet.offset);
  auto patterns = PatternDecoder::create(setup->format.width, setup->format.height);
  if (!patterns) return at(packet, patterns.error());
  patterns_.emplace(std::move(*patterns));
  pattern_packets_ = {};
  scene_ = Scene{*setup, std::nullopt, {}};
  motion_.reset();
  blend_.reset();
  timeline_ = {};
  lost_ = false;
  scene_begin_ = pictures_;
  bit_counter_.reset();
  geometry_.reset();
  surround_.reset();
  has_setup_ = true;
  announced_picture_ = false;
  return {};
}

void StreamDecoder::begin_geometry(const State& rest) {
  if (!geometry_) return;
  scene_.set_geometry({scene_.setup, *geometry_, surround_ ? std::move(*surround_) : still_surround(), rest});
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
  const bool first = scene_.patterns.empty();
  if (first != (pattern.picture == 0) || pattern.slot > static_cast<int>(scene_.patterns.size()))
    return fail(ErrorCode::kInvalidStream, "a pattern out of order");
  const State* known = first ? nullptr : timeline_.find(pattern.picture);
  if (!first && known == nullptr)
    return fail(ErrorCode::kInvalidStream, "a pattern of a picture without a state");
  auto frame = patterns_->decode_frame(pattern.av1);
  if (!frame) return fail(frame.error());
  const State seen = first ? state_of(pattern.state, scene_.setup.steps) : *known;
  if (first) {
    begin_geometry(seen);
    motion_.emplace(scene_.setup, pattern.state);
    if (scene_.setup.patterns > 1) blend_.emplace();
    if (counts_motion_bits_) bit_counter_.emplace(scene_.setup, pattern.state);
  }
  Pattern made = make_coded_pattern(std::move(frame->picture), seen, scene_.geometry, scene_.setup);
  if (pattern.slot < static_cast<int>(scene_.patterns.size()))
    scene_.patterns[pattern.slot] = std::move(made);
  else
    scene_.patterns.push_back(std::move(made));
  return frame->reduced;
}

void StreamDecoder::record(const Packet& packet, std::span<const PatternSyntax> patterns,
                           const std::vector<bool>& reduced) {
  std::uint64_t frames = 0, frames_before = 0;
  for (const PatternSyntax& pattern : patterns) frames += pattern.av1.size();
  const auto share = [&](std::uint64_t bytes) { return packet.size * bytes / frames; };
  for (std::size_t k = 0; k < patterns.size(); ++k) {
    const std::uint64_t frames_after = frames_before + patterns[k].av1.size();
    pattern_records_.push_back({patterns[k].slot,
                                scene_begin_ + static_cast<std::uint64_t>(patterns[k].picture),
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
