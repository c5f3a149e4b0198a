// Codes the observations of a scene with a face: combines patterns, planning and packets.
#pragma once

#include <optional>
#include <vector>

#include "decoder/scene/scene.h"
#include "encoder/analysis/face_analysis.h"
#include "encoder/patterns/chroma_contrast.h"
#include "encoder/patterns/mouth_colours.h"
#include "encoder/scene/scene_ledger.h"
#include "encoder/segment/segment_refit.h"
#include "encoder/surround/surround_learning.h"
#include "encoder/surround/surround_motion.h"

namespace fbs {

class FaceCoder {
 public:
  /// What a scene begins with.
  struct Start {
    Scene scene;  ///< with one pattern, and a guess of the surround's map
    CodedState seen;
    double eye_distance_px;
    RatePlan rate;
    std::vector<std::uint8_t> geometry_payload;
    std::vector<std::uint8_t> pattern_payload;
    SurroundObservations observations;
  };
  FaceCoder(const EncoderSettings& settings, Start start);

  /// Adds the next picture with its observation.
  Result<void> add(const SharedPicture& picture, FaceAnalysis::Observation seen, const PictureTime& when);
  /// The next picture begins another shot.
  void cut();
  Result<void> finish();

  /// Another scene is shown next.
  Result<void> leave() { return end_group(); }
  [[nodiscard]] SceneLedger& ledger() { return ledger_; }
  [[nodiscard]] bool has_several_patterns() const { return second_pass_.has_value(); }

 private:
  /// Adds body and ground to the observation of the next picture.
  void observe_surround(const Picture& picture, FaceAnalysis::Observation& seen);
  /// Until the scene starts: collects pictures for fitting the surround's map.
  void learn(const Picture& picture, const FaceAnalysis::Observation& seen);
  Result<void> plan_group();
  Result<void> end_group();
  /// Begins another scene with the same person at this picture: a place to join.
  Result<void> begin_again(const Picture& picture, const FaceAnalysis::Observation& seen);
  /// Fixes the content of the scene's head.
  void fix_head();
  /// Writes the head, with what is known now if it is not fixed yet.
  Result<void> write_head();
  /// Fits the surround's map to the observations so far.
  void fit_map();
  /// Ends the look-ahead for the surround's map: fixes the scene's head or, in a live scene, whose head has
  /// been sent, sends the map.
  Result<void> end_lookahead();
  /// With several patterns: codes and writes the pictures held back.
  /// @param last  of the scene
  Result<void> end_segment(bool last);

  SceneLedger ledger_;
  Scene scene_;  ///< as the decoder builds it; until its head is fixed, with a guess of the surround's map
  State rest_;   ///< in which the first pattern was seen: the map's
  std::vector<PictureCost> costs_;  ///< of the group's pictures
  MouthColours mouth_colours_;
  int pattern_speed_;  ///< Effort's
  SurroundLearning surround_;
  std::optional<SurroundMotion> surround_motion_;  ///< since the scene's first picture
  struct SecondPass {
    SegmentRefit refit;
    std::int32_t contrast;           ///< of patterns outside the face
    ChromaContrast chroma_contrast;  ///< until the scene starts
  };
  std::optional<SecondPass> second_pass_;     ///< nothing with one pattern
  std::vector<std::uint8_t> surround_again_;  ///< payload to be sent once more, behind the next group
  std::vector<std::uint8_t> geometry_payload_;
  std::vector<std::uint8_t> pattern_payload_;  ///< of pattern 0; empty where segments bring their own
};

}  // namespace fbs
