// Codes the observations of a scene with a face: combines patterns, planning and packets.
#pragma once

#include <optional>
#include <vector>

#include "decoder/scene/scene.h"
#include "encoder/analysis/face_analysis.h"
#include "encoder/patterns/face_chroma.h"
#include "encoder/patterns/mouth_colours.h"
#include "encoder/scene/scene_ledger.h"
#include "encoder/segment/segment_refit.h"
#include "encoder/surround/surround_learning.h"

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
  /// @param duration  1/90000 s; 0: the frame rate's
  Result<void> add(const Picture& picture, FaceAnalysis::Observation seen, std::uint32_t duration);
  /// The next picture begins another shot.
  void cut();
  Result<void> finish();

  void request_scene() { ledger_.request_scene(); }
  void set_bitrate(double kbps) { ledger_.set_bitrate(kbps); }
  void lose_patterns() { ledger_.lose_patterns(); }
  /// Whether the next picture begins another scene with the same person. For a live scene it is known ahead:
  /// live_scene_ends().
  [[nodiscard]] bool scene_ended() const { return ledger_.scene_ended(); }
  [[nodiscard]] bool live_scene_ends(std::uint64_t pictures) const {
    return ledger_.live_scene_ends(pictures);
  }
  /// The surround's map, once after each change.
  [[nodiscard]] std::optional<SurroundMap> take_new_map() { return surround_.take_new_map(); }

  [[nodiscard]] bool has_several_patterns() const { return second_pass_.has_value(); }
  /// Whole packets that are ready; forgets them.
  [[nodiscard]] std::vector<std::uint8_t> take() { return ledger_.packets().take(); }

 private:
  /// Until the scene starts: collects mouth colours, and pictures for fitting the surround's map.
  void learn(const Picture& picture, const FaceAnalysis::Observation& seen);
  Result<void> end_group();
  /// Begins another scene with the same person at this picture: a place to join.
  Result<void> begin_again(const Picture& picture, const FaceAnalysis::Observation& seen);
  /// Fixes the content of the scene's head.
  void fix_head();
  Result<void> write_head();
  /// Fits the surround's map to the observations so far.
  void fit_map();
  /// Ends the look-ahead for the surround's map: fixes the scene's head or, in a live scene, whose head has
  /// been sent, sends the map.
  Result<void> end_lookahead();
  /// With several patterns: codes and writes the pictures held back.
  Result<void> end_segment();

  SceneLedger ledger_;
  Scene scene_;  ///< as the decoder builds it; until its head is fixed, with a guess of the surround's map
  State rest_;   ///< in which the first pattern was seen: the map's
  std::vector<PictureCost> costs_;  ///< of the group's pictures
  MouthColours mouth_colours_;
  SurroundLearning surround_;
  bool fixed_ = false;  ///< whether fix_head() has been called
  struct SecondPass {
    SegmentRefit refit;
    std::int32_t contrast;     ///< of patterns outside the face
    FaceChroma face_chroma{};  ///< until the scene starts
  };
  std::optional<SecondPass> second_pass_;     ///< nothing with one pattern
  std::vector<std::uint8_t> surround_again_;  ///< payload to be sent once more, behind the next group
  std::vector<std::uint8_t> geometry_payload_;
  std::vector<std::uint8_t> pattern_payload_;  ///< of pattern 0; empty where segments bring their own
};

}  // namespace fbs
