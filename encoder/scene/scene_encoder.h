// One scene of a video: from the picture that begins it to the next scene or the end.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "bitstream/syntax.h"
#include "common/picture.h"
#include "common/result.h"
#include "encoder/analysis/picture_analysis.h"
#include "encoder/landmarks/landmark_file.h"
#include "encoder/plan/group_clock.h"

namespace fbs {

class Bell;
class SceneLedger;

class SceneEncoder {
 public:
  SceneEncoder() = default;
  SceneEncoder(const SceneEncoder&) = delete;
  SceneEncoder& operator=(const SceneEncoder&) = delete;
  virtual ~SceneEncoder() = default;

  /// Pushes the next picture, beginning with the scene's first.
  virtual Result<void> push(const Picture& picture, const PictureTime& when) = 0;

  /// The picture pushed last ends at this time, if its group has not been coded: GroupClock. Waits for those
  /// pushed before.
  /// @param time  since the beginning of the stream, 1/90000 s; nothing: as it was pushed
  /// @return the position behind it
  virtual StreamPosition end_picture(std::optional<std::uint64_t> time) = 0;

  /// Landmarks of the picture pushed next, by another tracker.
  virtual void give_landmarks(const LandmarkPoints& /*landmarks*/) {}

  /// The picture pushed next begins another shot, which the scene must carry.
  virtual void cut() = 0;

  /// Has a live scene behave otherwise from the pictures on that have not been coded. A scene that shows one
  /// still picture stays as it is.
  virtual Result<void> change(const std::function<void(SceneLedger&)>& /*how*/) { return {}; }

  /// Whether the picture, which is pushed next, shows the scene's person, who is then tracked again.
  [[nodiscard]] virtual bool recognises(const Picture& picture) = 0;

  /// Whether it can also carry a shot of anything else.
  [[nodiscard]] virtual bool carries_shots() const = 0;

  /// Whether another scene may be shown in between.
  [[nodiscard]] virtual bool can_go_on() const { return false; }
  /// Another scene is shown next. The scene can_go_on().
  virtual Result<void> leave() { return {}; }
  /// The picture pushed next is the scene's again, after leave().
  /// @param at  its position
  virtual Result<void> go_on(const StreamPosition& /*at*/) { return {}; }

  /// Codes everything still held back, if need be while the caller goes on. With several patterns, a picture
  /// that is pushed afterwards begins another scene.
  virtual Result<void> finish() = 0;
  /// Waits until all that was pushed before finish() is coded.
  virtual Result<void> wait() { return {}; }

  /// Whole packets that are ready; the scene forgets them. What they say of other scenes is not set:
  /// Setup::keeps, Return::scene and Return::aside.
  [[nodiscard]] virtual std::vector<std::uint8_t> take() = 0;

  /// Has the bell ring whenever threads of the scene's own have done something.
  virtual void ring(const std::shared_ptr<Bell>& /*bell*/) {}
  /// Whether packets may become ready without another call.
  [[nodiscard]] virtual bool is_coding() const { return false; }

  [[nodiscard]] virtual const PictureAnalysis& analysis() const = 0;
};

}  // namespace fbs
