#include "encoder/scene/face_coder.h"

#include <algorithm>
#include <utility>

#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "encoder/model/coded_numbers.h"
#include "encoder/patterns/first_pattern.h"
#include "encoder/segment/pass_settings.h"
#include "encoder/surround/surround_fit.h"

namespace fbs {
namespace {

/// Pictures that the surround's map is fitted to, spread over the look-ahead. More cost time and change
/// little.
constexpr std::uint64_t kSurroundPictures = 12;

/// Contrast of patterns outside the face. Against full contrast the face takes 3.5 % fewer bytes at the same
/// PSNR, the frame hardly more; 205 is 1 % better in the face and 1 % worse in the frame.
constexpr std::int32_t kSurroundContrast = 220;

}  // namespace

FaceCoder::FaceCoder(const SceneTiming& timing, const EncoderSettings& settings, Start start)
    : timing_(timing),
      rate_(start.rate),
      live_(settings.live.has_value()),
      key_interval_(key_interval_of(settings, start.scene.setup.format)),
      still_surround_(!settings.surround),
      scene_(std::move(start.scene)),
      rest_(scene_.patterns.front().seen),
      motion_(scene_.setup, start.seen, start.rate, timing.nominal_duration),
      position_(scene_.setup.before),
      mouth_colours_(mouth_height(scene_.geometry->project_vertices(scene_.patterns.front().seen)),
                     start.eye_distance_px),
      observations_(std::move(start.observations)),
      geometry_payload_(std::move(start.geometry_payload)),
      pattern_payload_(std::move(start.pattern_payload)) {
  if (settings.patterns != 1) {
    // Braces: clang 14 does not construct aggregates in place.
    second_pass_.emplace(
        SecondPass{face_patterns(settings, start.rate.point, scene_.setup.format, start.seen),
                   SegmentRefit(scene_.setup, scene_.geometry->geometry(), scene_.patterns.front(),
                                start.eye_distance_px),
                   motion_,
                   {}});
  }
}

Result<void> FaceCoder::add(const Picture& picture, FaceAnalysis::Observation seen, std::uint32_t duration) {
  if (std::exchange(ended_, false))
    if (auto begun = begin_again(picture, seen); !begun) return begun;
  if (second_pass_) second_pass_->refit.add(seen, duration);
  costs_.push_back(std::move(seen.cost));
  durations_.push_back(duration);
  if (!map_final_) learn(picture, seen);
  if (second_pass_) {
    if (!packets_.started() && seen.face) second_pass_->face_chroma.add(picture, seen.vertices);
    if (auto added = second_pass_->patterns->add(picture); !added) return added;
  }
  ++pictures_;
  position_.add(duration > 0 ? duration : timing_.nominal_duration);
  if (timing_.group_ends(durations_.size(), pictures_))
    if (auto ended = end_group(); !ended) return ended;
  if (!map_final_ && pictures_ >= timing_.lookahead)
    if (auto done = end_lookahead(); !done) return done;
  if (second_pass_ || !scene_ends(timing_.group_pictures)) return {};
  ended_ = true;
  requested_ = false;
  return finish();
}

bool FaceCoder::scene_ends(std::size_t more) const {
  if (key_interval_ == 0) return second_pass_.has_value();
  if (live_) return live_scene_ends(pictures_) || requested_;
  return durations_.empty() && static_cast<double>(pictures_ + more) > key_interval_;
}

Result<void> FaceCoder::begin_again(const Picture& picture, const FaceAnalysis::Observation& seen) {
  const CodedState rest = coded_state(seen.cost.fit, scene_.setup);
  rest_ = state_of(rest, scene_.setup.steps);
  scene_.set_geometry({scene_.setup, scene_.geometry->geometry(), map_, rest_});
  scene_.patterns.clear();
  scene_.patterns.push_back(make_pattern(picture, rest_, scene_.geometry));
  motion_ = MotionTrack(scene_.setup, rest, rate_, timing_.nominal_duration);
  if (second_pass_) {
    second_pass_->patterns->begin_scene(rest);
    second_pass_->motion = motion_;
  } else {
    FirstPattern first(scene_.setup.format, picture, kSentSpeed);
    auto coded = first.take(rate_.point.pattern_quantiser);
    if (!coded) return fail(coded.error());
    auto payload = encode_first_pattern({0, 0, rest, std::move(coded->av1)}, scene_.setup);
    if (!payload) return fail(payload.error());
    pattern_payload_ = std::move(*payload);
  }
  scene_.setup.before = position_;
  observations_.set_first(picture, rest_);
  fixed_ = map_final_ = false;
  pictures_ = 0;
  packets_.begin_again();
  return {};
}

void FaceCoder::cut() {
  if (second_pass_) second_pass_->patterns->cut();
}

void FaceCoder::learn(const Picture& picture, const FaceAnalysis::Observation& seen) {
  if (!seen.face) return;
  mouth_colours_.add(picture, seen.vertices);
  const std::uint64_t every = std::max<std::uint64_t>(1, timing_.lookahead / kSurroundPictures);
  if (!still_surround_ && pictures_ > 0 && pictures_ % every == 0) observations_.add(picture, seen.state);
}

Result<void> FaceCoder::end_group() {
  if (durations_.empty()) return {};
  if (live_ && !second_pass_ && !fixed_) {
    fix_head();
    if (auto written = write_head(); !written) return written;
  }
  auto group = motion_.add(costs_, durations_);
  if (!group) return fail(group.error());
  if (second_pass_)
    second_pass_->patterns->add(group->states, std::move(group->payload));
  else
    packets_.add_motion(group->payload);
  costs_.clear();
  durations_.clear();
  return second_pass_ && second_pass_->patterns->segment_ends(timing_.group_pictures) ? end_segment()
                                                                                      : Result<void>{};
}

void FaceCoder::fit_map() {
  const Geometry geometry = scene_.geometry->geometry();
  // A live scene that goes on with the same person keeps the map until its own pictures have shown more.
  const bool keeps = live_ && map_.columns > 0 && observations_.later().empty();
  if (still_surround_)
    map_ = still_surround();
  else if (!keeps)
    map_ = fit_surround(scene_.setup, geometry, observations_);
  new_map_ = map_;
  scene_.set_geometry({scene_.setup, geometry, map_, rest_});
}

void FaceCoder::fix_head() {
  mouth_colours_.set_chroma(scene_.setup.mouth);
  fit_map();
  fixed_ = true;
  if (!live_) end_learning();
}

Result<void> FaceCoder::end_lookahead() {
  if (!live_) {
    fix_head();
    return second_pass_ ? Result<void>{} : write_head();
  }
  if (!durations_.empty()) return {};  // the map changes between groups
  const SurroundMap before = map_;
  fit_map();
  end_learning();
  if (map_ == before) return {};
  auto surround = encode_surround(map_);
  if (!surround) return fail(surround.error());
  packets_.add(PacketType::kSurround, *surround);
  return {};
}

void FaceCoder::end_learning() {
  observations_ = SurroundObservations(scene_.setup.format);
  map_final_ = true;
}

Result<void> FaceCoder::write_head() {
  auto setup = encode_setup(scene_.setup);
  if (!setup) return fail(setup.error());
  auto surround = encode_surround(map_);
  if (!surround) return fail(surround.error());
  packets_.start({std::move(*setup), geometry_payload_, std::move(*surround), pattern_payload_});
  return {};
}

Result<void> FaceCoder::end_segment() {
  const std::size_t pictures = second_pass_->patterns->pictures();
  if (!fixed_) fix_head();
  if (!packets_.started()) {
    scene_.setup.patterns = second_pass_->patterns->store();
    scene_.setup.contrast = kSurroundContrast;
    scene_.setup.chroma_contrast = second_pass_->face_chroma.contrast();
    pattern_payload_.clear();  // the first segment brings its own
    if (auto written = write_head(); !written) return written;
  }
  const auto refit = [&](Segment& segment, const SegmentPatterns& patterns) {
    motion_ = second_pass_->motion;
    return second_pass_->refit.run(segment, patterns, motion_);
  };
  const auto packets = second_pass_->patterns->end_segment(scene_, packets_.counted(), refit);
  if (!packets) return fail(packets.error());
  second_pass_->motion = motion_;
  second_pass_->refit.begin_segment();
  for (const auto& [type, payload] : *packets) packets_.add(type, payload);
  packets_.count_from_here();
  ended_ = scene_ends(pictures);
  requested_ = requested_ && !ended_;
  return {};
}

Result<void> FaceCoder::finish() {
  if (auto ended = end_group(); !ended) return ended;
  if (second_pass_) return end_segment();
  if (!fixed_) fix_head();
  return packets_.started() ? Result<void>{} : write_head();
}

}  // namespace fbs
