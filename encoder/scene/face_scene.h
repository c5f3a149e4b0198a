// A scene with a face: the analysis of its pictures, and their coding.
#pragma once

#include <memory>
#include <vector>

#include "encoder/analysis/face_analysis.h"
#include "encoder/plan/scene_timing.h"
#include "encoder/scene/background.h"
#include "encoder/scene/face_coder.h"
#include "encoder/scene/scene_encoder.h"

namespace fbs {

/// Live, with several threads, a group is coded while the next pictures are analysed. The stream is the same.
class FaceScene : public SceneEncoder {
 public:
  /// @param finder  used again when the face is lost; must outlive the scene
  /// @param marks   on the first picture
  /// @param before  where in the stream the scene begins
  static Result<std::unique_ptr<SceneEncoder>> begin(const VideoFormat& format,
                                                     const EncoderSettings& settings,
                                                     const FaceFinder& finder, const Picture& first,
                                                     const Marks& marks, const StreamPosition& before = {});

  Result<void> push(const Picture& picture, std::uint32_t duration) override;
  void give_landmarks(const LandmarkPoints& landmarks) override { analysis_.give_landmarks(landmarks); }
  void cut() override {
    analysis_.cut();
    cut_ = true;
  }
  void request_scene() override;
  Result<void> set_bitrate(double kbps) override;
  Result<void> lose_patterns() override;
  [[nodiscard]] bool recognises(const Picture& picture) override { return analysis_.recognises(picture); }
  [[nodiscard]] bool carries_shots() const override { return coder_.has_several_patterns(); }
  Result<void> finish() override;
  [[nodiscard]] std::vector<std::uint8_t> take() override;
  [[nodiscard]] bool is_coding() const override { return !coding_.is_idle(); }
  [[nodiscard]] const PictureAnalysis& analysis() const override { return analysis_.report(); }

 private:
  /// A picture still to be coded.
  struct Seen {
    Picture picture;
    FaceAnalysis::Observation observation;
    std::uint32_t duration;
    bool cut;  ///< it begins another shot
  };
  struct FirstPicture {
    const Picture& picture;
    const Picture& pattern;  ///< that others are compared with
    glm::dvec2 centre;       ///< of the head in it, pixels
  };
  FaceScene(const SceneTiming& timing, const FaceFinder& finder, const EncoderSettings& settings,
            const FirstPicture& first, FaceCoder::Start start);

  [[nodiscard]] FaceAnalysis::Observation observed(const Picture& picture);
  /// Passes the coder's decisions to the analysis.
  void learn_from_coder();
  Result<void> code(Seen seen);
  /// Passes the group to the coder.
  Result<void> code_group();

  SceneTiming timing_;
  FaceAnalysis analysis_;
  bool begins_ = false;  ///< the next picture begins another scene of the coder
  bool cut_ = false;     ///< it begins another shot
  FaceCoder coder_;
  // Where the analysis runs ahead of the coder:
  bool ahead_;
  std::vector<Seen> group_;
  std::uint64_t pictures_ = 0;  ///< of the coder's scene, seen so far
  bool requested_ = false;      ///< that scene is to end
  bool learned_ = false;        ///< the coder has the pictures for fitting the surround's map
  bool coder_leads_ = false;    ///< its decisions on the last group affect the analysis of the next picture
  Background coding_;           ///< uses the coder; last, so that it ends first
};

}  // namespace fbs
