// A scene with a face: joins analysis, patterns, planning and packets.
#pragma once

#include <memory>
#include <optional>

#include "decoder/scene.h"
#include "encoder/face_analysis.h"
#include "encoder/motion_track.h"
#include "encoder/pattern_stage.h"
#include "encoder/patterns/face_chroma.h"
#include "encoder/patterns/mouth_colours.h"
#include "encoder/scene_encoder.h"
#include "encoder/scene_packets.h"
#include "encoder/scene_timing.h"
#include "encoder/segment_refit.h"
#include "encoder/surround/surround_observations.h"

namespace fbs {

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
  void cut() override;
  [[nodiscard]] bool recognises(const Picture& picture) override { return analysis_.recognises(picture); }
  [[nodiscard]] bool carries_shots() const override { return second_pass_.has_value(); }
  Result<void> finish() override;
  [[nodiscard]] std::vector<std::uint8_t> take() override { return packets_.take(); }
  [[nodiscard]] const PictureAnalysis& analysis() const override { return analysis_.report(); }

 private:
  /// What begin() has made.
  struct Parts;
  FaceScene(const SceneTiming& timing, const FaceFinder& finder, const EncoderSettings& settings,
            Parts parts);

  /// Until the scene starts: mouth colours, and what the surround's map is fitted to.
  void learn(const Picture& picture, const FaceAnalysis::Observation& seen);
  Result<void> end_group();
  /// Begins another scene with the same person at this picture: a place to join.
  Result<void> begin_again(const Picture& picture, const FaceAnalysis::Observation& seen);
  /// Whether the next picture is to begin another scene, which otherwise could only after so many more.
  [[nodiscard]] bool scene_ends(std::size_t more) const;
  /// Fixes what the scene's head says.
  void fix_head();
  Result<void> write_head();
  /// Fits the surround's map to what has been seen by now.
  void fit_map();
  /// Enough has been seen for the surround's map: fixes what the scene's head says, or in a live scene, whose
  /// head has been sent, sends the map.
  Result<void> end_lookahead();
  /// Nothing more is learned for the map.
  void end_learning();
  /// With several patterns: codes and writes what has been held back.
  Result<void> end_segment();

  SceneTiming timing_;
  RatePlan rate_;
  bool live_;
  double key_interval_;  ///< pictures; 0: none where there is one pattern, segments where there are several
  bool still_surround_;
  Scene scene_;  ///< as the decoder builds it; until start() with a guessed surround map
  State rest_;   ///< in which the first pattern was seen: the map's
  FaceAnalysis analysis_;

  MotionTrack motion_;
  std::vector<PictureCost> costs_;        ///< of the group's pictures
  std::vector<std::uint32_t> durations_;  ///< of the same, 1/90000 s; 0: nominal
  std::uint64_t pictures_ = 0;            ///< of the scene
  bool ended_ = false;                    ///< the next picture begins another scene
  StreamPosition position_;               ///< behind the last picture

  MouthColours mouth_colours_;
  SurroundObservations observations_;  ///< empty once the map is final
  bool fixed_ = false;                 ///< whether fix_head() has been called
  bool map_final_ = false;
  SurroundMap map_;
  struct SecondPass {
    std::unique_ptr<PatternStage> patterns;
    SegmentRefit refit;
    MotionTrack motion;        ///< as before the segment
    FaceChroma face_chroma{};  ///< until the scene starts
  };
  std::optional<SecondPass> second_pass_;  ///< nothing with one pattern
  std::vector<std::uint8_t> geometry_payload_;
  std::vector<std::uint8_t> pattern_payload_;  ///< of pattern 0; empty where segments bring their own
  ScenePackets packets_;
};

}  // namespace fbs
