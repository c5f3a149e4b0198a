#include "encoder/scene/face_coder.h"

#include <algorithm>
#include <utility>

#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/payload/setup_payload.h"
#include "bitstream/payload/surround_payload.h"
#include "encoder/model/coded_numbers.h"
#include "encoder/patterns/first_pattern.h"
#include "encoder/plan/pattern_point.h"
#include "encoder/segment/pass_settings.h"

namespace fbs {
namespace {

/// Pictures for fitting the surround's map, spread over the look-ahead. More cost time and change little.
constexpr std::uint64_t kSurroundPictures = 12;

}  // namespace

FaceCoder::FaceCoder(const EncoderSettings& settings, Start start)
    : ledger_(start.scene.setup, start.seen, start.rate, settings,
              settings.patterns == 1 ? nullptr
                                     : pattern_stage(pass_settings(settings, start.rate.point), settings,
                                                     start.scene.setup.format, start.seen)),
      scene_(std::move(start.scene)),
      rest_(scene_.patterns.front().seen),
      mouth_colours_(mouth_height(scene_.geometry->project_vertices(scene_.patterns.front().seen)),
                     start.eye_distance_px),
      pattern_speed_(Effort::of(settings.effort).pattern_speed),
      surround_(std::move(start.observations), !settings.surround, ledger_.live()),
      geometry_payload_(std::move(start.geometry_payload)),
      pattern_payload_(std::move(start.pattern_payload)) {
  if (settings.patterns != 1)  // Braces: clang 14 does not construct aggregates in place.
    second_pass_.emplace(
        SecondPass{SegmentRefit(scene_.setup, scene_.geometry->geometry(), scene_.patterns.front(),
                                start.eye_distance_px, ledger_.motion()),
                   surround_contrast(settings.tune), ChromaContrast(chroma_contrast(settings.tune))});
}

Result<void> FaceCoder::add(const SharedPicture& picture, FaceAnalysis::Observation seen,
                            const PictureTime& when) {
  if (!surround_.is_still()) observe_surround(picture, seen);
  if (ledger_.scene_ended())
    if (auto begun = begin_again(picture, seen); !begun) return begun;
  if (!surround_.has_ended()) learn(picture, seen);
  if (!ledger_.packets().started() && seen.face) {
    mouth_colours_.add(picture, seen.vertices);
    if (second_pass_) second_pass_->chroma_contrast.add(picture);
  }
  if (second_pass_) second_pass_->refit.add(seen);
  costs_.push_back(std::move(seen.cost));
  if (auto added = ledger_.add(picture, when); !added) return added;
  if (ledger_.group_ends())
    if (auto ended = end_group(); !ended) return ended;
  if (!surround_.has_ended() && ledger_.pictures() >= ledger_.timing().lookahead)
    if (auto done = end_lookahead(); !done) return done;
  return second_pass_ || !ledger_.scene_ends() ? Result<void>{} : finish();
}

Result<void> FaceCoder::begin_again(const Picture& picture, const FaceAnalysis::Observation& seen) {
  const CodedState rest = coded_state(seen.cost.fit, scene_.setup);
  rest_ = state_of(rest, scene_.setup.steps);
  scene_.set_geometry({scene_.setup, scene_.geometry->geometry(), surround_.map(), rest_});
  scene_.patterns.clear();
  scene_.patterns.push_back(make_pattern(picture, rest_, scene_.geometry));
  ledger_.begin_again(scene_.setup);
  ledger_.begin_motion(scene_.setup, rest);
  if (second_pass_) {
    second_pass_->refit.begin_segment(ledger_.motion());
  } else {
    FirstPattern first(scene_.setup.format, picture, pattern_speed_);
    auto coded = first.take(ledger_.rate().point.pattern_quantiser);
    if (!coded) return fail(coded.error());
    auto payload = encode_first_pattern({0, 0, rest, std::move(coded->av1)}, scene_.setup);
    if (!payload) return fail(payload.error());
    pattern_payload_ = std::move(*payload);
  }
  surround_.begin_again(picture, rest_);
  return {};
}

void FaceCoder::cut() {
  if (second_pass_) ledger_.patterns()->cut();
}

void FaceCoder::observe_surround(const Picture& picture, FaceAnalysis::Observation& seen) {
  if (const auto map = surround_.take_new_map(); map && surround_motion_) surround_motion_->set_map(*map);
  if (!surround_motion_)
    surround_motion_.emplace(picture, rest_);
  else if (ledger_.scene_ended())
    surround_motion_.emplace(picture, seen.state);
  if (seen.in_shot) surround_motion_->observe(picture, seen.pose);
  surround_motion_->add_to(seen.cost);
  surround_motion_->add_to(seen.state);
}

void FaceCoder::learn(const Picture& picture, const FaceAnalysis::Observation& seen) {
  if (!seen.face) return;
  const std::uint64_t every = std::max<std::uint64_t>(1, ledger_.timing().lookahead / kSurroundPictures);
  const std::uint64_t before = ledger_.pictures();
  if (before > 0 && before % every == 0) surround_.add(picture, seen.state);
}

Result<void> FaceCoder::plan_group() {
  if (!ledger_.in_group()) return {};
  if (ledger_.live() && !second_pass_ && !ledger_.packets().started())
    if (auto written = write_head(); !written) return written;
  std::vector<std::uint32_t> durations = ledger_.end_group();
  if (auto planned = ledger_.plan(costs_, durations); !planned) return planned;
  if (second_pass_) second_pass_->refit.end_group(std::move(durations));
  costs_.clear();
  return {};
}

Result<void> FaceCoder::end_group() {
  if (auto planned = plan_group(); !planned) return planned;
  if (!ledger_.segment_ends()) return {};
  return end_segment(ledger_.scene_ends());
}

void FaceCoder::fit_map() {
  const Geometry geometry = scene_.geometry->geometry();
  surround_.fit(scene_.setup, geometry);
  scene_.set_geometry({scene_.setup, geometry, surround_.map(), rest_});
}

void FaceCoder::fix_head() {
  fit_map();
  if (!ledger_.live() || ledger_.pictures() >= ledger_.timing().lookahead) surround_.end(scene_.setup.format);
}

Result<void> FaceCoder::end_lookahead() {
  if (!ledger_.live()) {
    fix_head();
    return second_pass_ ? Result<void>{} : write_head();
  }
  if (ledger_.in_group() || !ledger_.packets().started()) return {};  // the map changes between groups
  const SurroundMap before = surround_.map();
  fit_map();
  surround_.end(scene_.setup.format);
  if (surround_.map() == before) return {};
  auto surround = encode_surround(surround_.map());
  if (!surround) return fail(surround.error());
  ledger_.packets().add(PacketType::kSurround, *surround);
  if (ledger_.timing().repeats_moved) surround_again_ = std::move(*surround);
  return {};
}

Result<void> FaceCoder::write_head() {
  if (!surround_.has_ended()) fix_head();
  mouth_colours_.set_chroma(scene_.setup.mouth);
  auto setup = encode_setup(scene_.setup);
  if (!setup) return fail(setup.error());
  auto surround = encode_surround(surround_.map());
  if (!surround) return fail(surround.error());
  ledger_.packets().start({std::move(*setup), geometry_payload_, std::move(*surround), pattern_payload_});
  return {};
}

Result<void> FaceCoder::end_segment(bool last) {
  if (!ledger_.packets().started()) {
    scene_.setup.patterns = ledger_.patterns()->slots();
    scene_.setup.contrast = second_pass_->contrast;
    scene_.setup.chroma_contrast = second_pass_->chroma_contrast.contrast();
    pattern_payload_.clear();  // the first segment brings its own
    if (auto written = write_head(); !written) return written;
  }
  SegmentRefit& refit = second_pass_->refit;
  auto ended = ledger_.end_segment(
      scene_, last, [&](Segment& segment, const SegmentPatterns& drawn_from, Workers& workers) {
        return refit.run(segment, drawn_from, workers);
      });
  if (!ended) return ended;
  if (!surround_again_.empty())
    ledger_.packets().add(PacketType::kSurround, std::exchange(surround_again_, {}));
  if (refit.motion()) ledger_.set_motion(*refit.motion());
  refit.begin_segment(ledger_.motion());
  return {};
}

Result<void> FaceCoder::finish() {
  if (auto planned = plan_group(); !planned) return planned;
  if (second_pass_) return end_segment(true);
  ledger_.end_scene();
  return ledger_.packets().started() ? Result<void>{} : write_head();
}

}  // namespace fbs
