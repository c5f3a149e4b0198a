#include "decoder/scene/scene_builder.h"

#include <algorithm>
#include <utility>

namespace fbs {

void SceneBuilder::begin(const Setup& setup, PatternDecoder patterns) {
  *this = {};
  scene_->setup = setup;
  patterns_.emplace(std::move(patterns));
}

void SceneBuilder::apply_surround() {
  if (geometry_) change().set_geometry({scene_->setup, *geometry_, surround_, rest_});
}

Scene& SceneBuilder::change() {
  if (std::exchange(shared_, false)) scene_ = std::make_shared<Scene>(*scene_);
  return *scene_;
}

// SPEC 4.4
Result<DecodedFrame> SceneBuilder::decode_next(const PatternSyntax& pattern) {
  if (pattern.picture == 0) {
    first_ = pattern.av1;
    return patterns_->decode_frame(first_);
  }
  chained_ = chained_ || !pattern.alone;
  std::optional<PatternDecoder>& decoder = pattern.alone && chained_ ? alone_ : patterns_;
  if (!decoder) {
    auto begun = PatternDecoder::create(scene_->setup.format.width, scene_->setup.format.height);
    if (!begun) return fail(begun.error());
    if (auto first = begun->decode_frame(first_); !first) return first;
    decoder.emplace(std::move(*begun));
  }
  auto frame = decoder->decode_frame(pattern.av1);
  if (pattern.alone && (!frame || frame->referable)) decoder.reset();
  return frame;
}

Result<DecodedFrame> SceneBuilder::decode(const PatternSyntax& pattern, bool keeps) {
  const auto known = std::find_if(decoded_.begin(), decoded_.end(), [&](const Decoded& d) {
    return d.picture == pattern.picture && d.slot == pattern.slot;
  });
  if (known != decoded_.end()) return known->frame;
  if (!keeps) decoded_.clear();
  auto frame = decode_next(pattern);
  if (frame && keeps) decoded_.push_back({pattern.picture, pattern.slot, *frame});
  return frame;
}

Result<SceneBuilder::MadePattern> SceneBuilder::make(const ScenePattern& pattern, bool keeps) {
  auto frame = decode(pattern.coded, keeps);
  if (!frame) return fail(frame.error());
  if (pattern.is_first()) {
    rest_ = pattern.seen;
    apply_surround();
  }
  MadePattern made{
      make_coded_pattern(std::move(frame->picture), pattern.seen, scene_->geometry, scene_->setup),
      frame->reduced};
  made.pattern.slot = pattern.coded.slot;
  return made;
}

}  // namespace fbs
