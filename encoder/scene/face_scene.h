// A scene with a face: the analysis of its pictures, and their coding.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "encoder/analysis/face_analysis.h"
#include "encoder/scene/background.h"
#include "encoder/scene/face_coder.h"
#include "encoder/scene/scene_encoder.h"
#include "encoder/segment/picture_spool.h"

namespace fbs {

/// With several threads, a picture is analysed while the caller has the next one ready, and those before are
/// coded. The stream is the same.
class FaceScene : public SceneEncoder {
 public:
  /// @param finder  used again when the face is lost; must outlive the scene
  /// @param marks   on the first picture
  /// @param before  where in the stream the scene begins
  static Result<std::unique_ptr<SceneEncoder>> begin(const VideoFormat& format,
                                                     const EncoderSettings& settings,
                                                     const FaceFinder& finder, const Picture& first,
                                                     const Marks& marks, const StreamPosition& before = {});

  Result<void> push(const Picture& picture, const PictureTime& when) override;
  StreamPosition end_picture(std::optional<std::uint64_t> time) override;
  void give_landmarks(const LandmarkPoints& landmarks) override { settled().give_landmarks(landmarks); }
  void cut() override {
    settled().cut();
    cut_ = true;
  }
  Result<void> change(const std::function<void(SceneLedger&)>& how) override;
  [[nodiscard]] bool recognises(const Picture& picture) override { return settled().recognises(picture); }
  [[nodiscard]] bool carries_shots() const override { return coder_.has_several_patterns(); }
  [[nodiscard]] bool can_go_on() const override { return can_go_on_; }
  Result<void> leave() override;
  Result<void> go_on(const StreamPosition& at) override {
    return change([at](SceneLedger& ledger) { ledger.go_on(at); });
  }
  Result<void> finish() override;
  Result<void> wait() override;
  [[nodiscard]] std::vector<std::uint8_t> take() override;
  void ring(const std::shared_ptr<Bell>& bell) override {
    analysing_.ring(bell);
    coding_.ring(bell);
  }
  [[nodiscard]] bool is_coding() const override { return !analysing_.is_idle() || !coding_.is_idle(); }
  [[nodiscard]] const PictureAnalysis& analysis() const override {
    analysing_.settle();
    return analysis_.report();
  }

 private:
  struct FirstPicture {
    const Picture& picture;
    const Picture& pattern;  ///< that others are compared with
    glm::dvec2 centre;       ///< of the head in it, pixels
  };
  /// @param ahead  pictures that may be analysed and not yet coded; 0: the caller codes each at once
  FaceScene(const FaceFinder& finder, const EncoderSettings& settings, const FirstPicture& first,
            FaceCoder::Start start, std::size_t ahead);

  /// The analysis, once all pictures pushed are analysed.
  [[nodiscard]] FaceAnalysis& settled() {
    analysing_.settle();
    return analysis_;
  }
  /// Has the coder do something with all pictures analysed so far.
  Result<void> code(std::function<Result<void>()> task);
  /// The same with all pictures pushed so far.
  Result<void> code_later(std::function<Result<void>()> task);

  FaceAnalysis analysis_;  ///< changed by tasks of analysing_, or once it has settled
  bool can_go_on_;
  bool cut_ = false;      ///< the next picture begins another shot
  PictureQueue waiting_;  ///< pictures analysed and not yet coded
  FaceCoder coder_;       ///< what changes is coding_'s alone
  mutable std::mutex mutex_;
  std::vector<std::uint8_t> ready_;  ///< under the mutex
  // Last, so that they end first; analysing_ adds to coding_.
  Background coding_, analysing_;
};

}  // namespace fbs
