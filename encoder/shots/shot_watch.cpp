#include "encoder/shots/shot_watch.h"

namespace fbs {
namespace {

// Pictures between searches while no face is tracked, and between searches that include small faces.
constexpr std::uint64_t kSearchEvery = 5, kSearchAllEvery = 30;

/// After a longer loss the face may be another one: whoever is found is tracked.
constexpr double kLostForSeconds = 2;

/// The previous scene carries a shot without a face, such as a slide, for this long. A separate scene shows
/// it better, but costs the returning face 2 or 3 kB. The same for a face lost within a shot, as in an empty
/// room, did not pay.
constexpr double kInsertSeconds = 1;

/// A face that emerges from the dark is tracked once its light has come, or after this many seconds.
constexpr double kLongestFade = 3;

}  // namespace

ShotWatch::Step ShotWatch::next() {
  if (cut_) {
    follows_ = false;
    cut_to_ = true;
    in_shot_ = 0;
    fade_in_.begin();
  }
  faded_in_ = fade_in_.has_ended(cuts_.last());
  if (!faded_in_ && follows_ && lasts(lost_, kLostForSeconds)) {
    follows_ = cut_to_ = false;
    in_shot_ = 0;
  }
  const bool waits = scene_ && fade_in_.is_rising() && !lasts(in_shot_, kLongestFade);
  const bool searches = faded_in_ || (!follows_ && in_shot_ % kSearchEvery == 0 && !waits);
  return {cut_, searches, searches && !faded_in_ && scene_ && scene_->carries_shots,
          in_shot_ % kSearchAllEvery == 0};
}

bool ShotWatch::scene_begins(bool face) {
  // After a fade the picture is much better than the one that the scene began with; better dark than lost.
  if (faded_in_ && follows_ && !face) return false;
  follows_ = face;
  if (face || faded_in_ || !scene_ || (cut_ && !scene_->carries_shots)) return true;
  return scene_->has_face && scene_->carries_shots && cut_to_ && lasts(lost_, kInsertSeconds);
}

void ShotWatch::begin_scene(const SceneTraits& scene) {
  fade_in_.begin();
  scene_ = scene;
}

void ShotWatch::end_picture(bool followed) {
  lost_ = followed ? 0 : lost_ + 1;
  ++in_shot_;
}

}  // namespace fbs
