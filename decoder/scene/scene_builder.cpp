#include "decoder/scene/scene_builder.h"

#include <utility>

namespace fbs {

void SceneBuilder::begin(const Setup& setup, PatternDecoder patterns) {
  *this = {};
  scene_.setup = setup;
  patterns_.emplace(std::move(patterns));
}

void SceneBuilder::apply_surround() {
  if (geometry_) scene_.set_geometry({scene_.setup, *geometry_, surround_, rest_});
}

Result<SceneBuilder::MadePattern> SceneBuilder::make(const ScenePattern& pattern) {
  auto frame = patterns_->decode_frame(pattern.coded.av1);
  if (!frame) return fail(frame.error());
  if (pattern.is_first()) {
    rest_ = pattern.seen;
    apply_surround();
  }
  MadePattern made{make_coded_pattern(std::move(frame->picture), pattern.seen, scene_.geometry, scene_.setup),
                   frame->reduced};
  made.pattern.slot = pattern.coded.slot;
  return made;
}

}  // namespace fbs
