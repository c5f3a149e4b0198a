#include "decoder/stream/stream_decoder.h"

#include <algorithm>
#include <string>
#include <utility>

namespace fbs {
namespace {

/// Patterns that are kept until a packet of the link comes late: for some ten seconds of a call.
constexpr std::size_t kMostKept = 16;

constexpr const char* kNoPicture = "no picture has been decoded yet";

void copy(const Plane& from, const PlaneView& to) {
  for (int y = 0; y < to.height; ++y) std::copy_n(from.row(y), to.width, to.row(y));
}

std::string missing_text(std::uint64_t pictures) {
  return std::to_string(pictures) + (pictures == 1 ? " picture is" : " pictures are") + " missing";
}

}  // namespace

void StreamDecoder::feed_packet(std::uint64_t number, std::span<const std::uint8_t> bytes) {
  if (!late_.has_begun()) packets_.feed(kSignature);
  const std::size_t begin = std::min(bytes.size(), kSignature.size());
  if (std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(begin), kSignature.begin(),
                 kSignature.end()))
    bytes = bytes.subspan(begin);
  late_.feed(number, bytes);
}

Result<DecodeStatus> StreamDecoder::next() {
  for (;;) {
    if (reader_.pictures().has_next()) return show();
    if (clock_.is_behind()) return hold();
    const auto read = packets_.next();
    if (!read) {
      if (const auto error = lose_packet(read.error())) return fail(*error);
      continue;
    }
    if (read->status == ReadStatus::kNeedMore) {
      if (late_.has_begun() && packets_.begin_packet()) {
        const Error cut = {ErrorCode::kInvalidStream, "a packet of the link is cut off", packets_.offset()};
        if (const auto error = lose_packet(cut)) return fail(*error);
      }
      if (!feed_next()) return DecodeStatus::kNeedMore;
      continue;
    }
    if (read->status == ReadStatus::kEnd) {
      if (reader_.has_setup() || reader_.has_losses()) return DecodeStatus::kEnd;
      reader_.lose();  // reported once
      return fail(ErrorCode::kTruncated, "the stream ends before its setup", packets_.offset());
    }
    if (unsure_ && read->packet.repaired) {  // rather of a scene that is not known
      const Error unknown = {ErrorCode::kInvalidStream, "a packet is damaged", read->packet.offset};
      if (const auto error = lose_packet(unknown)) return fail(*error);
      continue;
    }
    if (!read->packet.in_parts) tally_.count(read->packet);
    if (auto taken = take(read->packet); !taken) return fail(taken.error());
    if (reader_.pictures().has_next()) tally_.note_startup();
  }
}

bool StreamDecoder::feed_next() {
  const auto bytes = late_.next(reader_);
  if (bytes) {
    if (late_.is_behind_gap()) {
      unsure_ = true;
      clock_.lose();
    }
    packets_.feed(*bytes);
  } else if (late_.is_closed()) {
    packets_.close();
  }
  return bytes || late_.is_closed();
}

std::optional<Error> StreamDecoder::lose_packet(const Error& error) {
  // Without a signature the stream is joined in its middle: no loss is known.
  if (error.code != ErrorCode::kNotFbs) clock_.lose();
  reader_.lose();
  ++strangers_;
  const bool explained = std::exchange(unsure_, late_.has_begun());
  return explained ? std::nullopt : std::optional(error);
}

DecodeStatus StreamDecoder::show() {
  late_.begin_pictures();
  const Timeline::Entry next = reader_.pictures().next();
  ++announced_;
  const PictureQuality quality = next.guessed                    ? PictureQuality::kInterpolated
                                 : reader_.has_broken_patterns() ? PictureQuality::kPatternMissing
                                                                 : PictureQuality::kExact;
  picture_ = {next.state, clock_.now(), next.duration, quality, scene_->shared()};
  clock_.show(next.duration);
  return DecodeStatus::kPicture;
}

DecodeStatus StreamDecoder::hold() {
  ++announced_;
  picture_.position = clock_.now();
  picture_.duration = clock_.hold(nominal_duration(format().frame_rate));
  picture_.quality = PictureQuality::kHeld;
  return DecodeStatus::kPicture;
}

void StreamDecoder::use_threads(int threads, const Hooks& hooks) {
  ahead_ = threads > 1 ? std::make_unique<PicturesAhead>(threads - 1, hooks) : nullptr;
}

Result<Picture> StreamDecoder::take_ahead() {
  const bool in_a_row = std::exchange(rendered_, announced_) + 1 == announced_;
  if (in_a_row) expect_next();  // otherwise the caller wants not all of them
  return ahead_->take(announced_, renderer_, scene(), state());
}

void StreamDecoder::expect_next() {
  for (std::uint64_t k = 0; k < ahead_->most(); ++k) {
    const Timeline::Entry* const entry = reader_.pictures().behind_next(static_cast<std::int32_t>(k));
    if (entry == nullptr) return;
    ahead_->expect(announced_ + 1 + k, picture_.scene, entry->state);
  }
}

Result<void> StreamDecoder::render(Picture& out) {
  if (pictures() == 0) return fail(ErrorCode::kInvalidArgument, kNoPicture);
  if (!ahead_) return renderer_.render(scene(), state(), out);
  auto drawn = take_ahead();
  if (!drawn) return fail(drawn.error());
  std::swap(out, *drawn);
  ahead_->give_back(std::move(*drawn));
  return {};
}

Result<void> StreamDecoder::render(const PictureView& out) {
  if (pictures() == 0) return fail(ErrorCode::kInvalidArgument, kNoPicture);
  if (!ahead_ || out.y.width != format().width || out.y.height != format().height)
    return renderer_.render(scene(), state(), out);
  auto drawn = take_ahead();
  if (!drawn) return fail(drawn.error());
  copy(drawn->y, out.y);
  copy(drawn->u, out.u);
  copy(drawn->v, out.v);
  ahead_->give_back(std::move(*drawn));
  return {};
}

Result<void> StreamDecoder::render_state(const State& state, std::optional<std::size_t> pattern,
                                         Picture& out) {
  if (pictures() == 0) return render(out);
  return pattern ? renderer_.render_from(*pattern, scene(), state, out)
                 : renderer_.render(scene(), state, out);
}

Result<void> StreamDecoder::render_state(const State& state, const PictureView& out) {
  if (pictures() == 0) return render(out);
  return renderer_.render(scene(), state, out);
}

Result<void> StreamDecoder::take(const Packet& packet) {
  const Arrived arrived{packet, reader_.has_losses()};
  if (enters_scene(packet.type)) late_.begin_scene();
  if (enters_scene(packet.type) || is_of_scene(packet.type)) {
    unsure_ = false;
    strangers_ = 0;
  }
  auto syntax = reader_.read(packet);
  auto taken = syntax ? std::visit([&](auto& s) { return take(s, arrived); }, *syntax)
                      : Result<void>(fail(syntax.error()));
  if (taken) return taken;
  if (is_of_scene(packet.type)) reader_.lose();
  if (is_of_scene(packet.type) || (enters_scene(packet.type) && reader_.lost())) clock_.lose();
  return fail(taken.error().code, taken.error().text, packet.offset);
}

// SPEC 6.1
Result<void> StreamDecoder::take(const Setup& setup, const Arrived& arrived) {
  auto patterns = decoder_for(setup);
  if (!patterns) {
    reader_.lose_scene();
    return fail(patterns.error());
  }
  if (late_.has_begun() && announced_ == 0) clock_ = {};  // what came before it is not shown
  scene_ = scenes_[reader_.scene()] = std::make_shared<SceneBuilder>();
  scene_->begin(setup, std::move(*patterns));
  return enter(setup.before, arrived);
}

// SPEC 6.6
Result<void> StreamDecoder::take(const Return& to, const Arrived& arrived) {
  scene_ = scenes_.at(reader_.scene());
  return enter(to.before, arrived);
}

Result<void> StreamDecoder::enter(const StreamPosition& before, const Arrived& arrived) {
  std::erase_if(scenes_, [&](const auto& scene) { return !reader_.knows(scene.first); });
  const auto missing = clock_.go_to(before);
  if (missing) return report_missing(*missing, arrived.lost);
  reader_.lose_scene();
  return fail(missing.error());
}

Result<PatternDecoder> StreamDecoder::decoder_for(const Setup& setup) const {
  const VideoFormat &now = format(), &next = setup.format;
  if (now.width > 0 && (next.width != now.width || next.height != now.height))
    return fail(ErrorCode::kUnsupported, "the picture size changes inside the stream");
  const auto pixels = static_cast<std::uint64_t>(next.width) * static_cast<std::uint64_t>(next.height);
  if (max_pixels_ && pixels > *max_pixels_)
    return fail(ErrorCode::kTooLarge, "the picture has more pixels than are allowed");
  return PatternDecoder::create(next.width, next.height);
}

// SPEC 4.7
Result<void> StreamDecoder::take(const End& end, const Arrived& arrived) {
  end_ = end.pictures;
  late_.give_up();  // pictures are held in place of those that are missing
  const std::uint32_t nominal = format().width > 0 ? nominal_duration(format().frame_rate) : 1;
  const auto missing = clock_.go_to_end(end.pictures, nominal);
  if (!missing) return fail(missing.error());
  return report_missing(*missing, arrived.lost);
}

Result<void> StreamDecoder::report_missing(std::uint64_t missing, bool reported) const {
  const bool left_out = missing > 0 && pictures() > 0 && !clock_.is_behind();
  if (missing == 0 || (reported && (!left_out || late_.has_begun()))) return {};
  const std::string text = missing_text(missing);
  if (left_out) return fail(ErrorCode::kTooLarge, text + ", too many to be held");
  return fail(ErrorCode::kInvalidStream, text);
}

Result<void> StreamDecoder::take(const Geometry& geometry, const Arrived& /*arrived*/) {
  scene_->set_geometry(geometry);
  return {};
}

Result<void> StreamDecoder::take(const SurroundMap& surround, const Arrived& /*arrived*/) {
  if (scene_->set_surround(surround) && scene_->scene().geometry) scene_->apply_surround();
  return {};
}

Result<void> StreamDecoder::take(const std::vector<ScenePattern>& patterns, const Arrived& arrived) {
  std::vector<bool> reduced;
  for (const ScenePattern& pattern : patterns) {
    if (scene_->kept() >= kMostKept) late_.give_up();
    auto made = scene_->make(pattern, late_.is_kept());
    if (!made) {
      if (pattern.is_first())
        reader_.lose_scene();
      else if (!pattern.coded.alone)
        reader_.lose_patterns();
      return fail(made.error());
    }
    reduced.push_back(made->reduced);
    scene_->store(std::move(made->pattern));
  }
  tally_.add(arrived.packet, reader_, patterns, reduced);
  return {};
}

Result<void> StreamDecoder::take(const MotionGroup& group, const Arrived& arrived) {
  tally_.add(group, reader_);
  if (group.missing > 0) clock_.lose();
  if (group.missing == 0 || arrived.lost) return {};
  return fail(ErrorCode::kInvalidStream, missing_text(static_cast<std::uint64_t>(group.missing)));
}

Result<void> StreamDecoder::take(const BlendGroup& group, const Arrived& arrived) {
  if (group.missing == 0 || arrived.lost) return {};
  return fail(ErrorCode::kInvalidStream, "it is not known how pictures are blended");
}

Result<void> StreamDecoder::take(SoundGroup& group, const Arrived& /*arrived*/) {
  return sound_.add({*sound_setup(), std::move(group)});
}

// SPEC 6.5
Result<void> StreamDecoder::take(const JoinedHead& head, const Arrived& /*arrived*/) {
  packets_.read_head(head.packets);
  return {};
}

}  // namespace fbs
