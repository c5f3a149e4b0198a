// Codes what has been seen in a scene with a face: joins patterns, planning and packets.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "decoder/scene/scene.h"
#include "encoder/analysis/face_analysis.h"
#include "encoder/patterns/face_chroma.h"
#include "encoder/patterns/mouth_colours.h"
#include "encoder/plan/motion_track.h"
#include "encoder/plan/scene_timing.h"
#include "encoder/scene/scene_packets.h"
#include "encoder/segment/pattern_stage.h"
#include "encoder/segment/segment_refit.h"
#include "encoder/surround/surround_observations.h"

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
  FaceCoder(const SceneTiming& timing, const EncoderSettings& settings, Start start);

  /// The next picture, and what the analysis saw in it.
  /// @param duration  1/90000 s; 0: that of the frame rate
  Result<void> add(const Picture& picture, FaceAnalysis::Observation seen, std::uint32_t duration);
  /// The next picture begins another shot.
  void cut();
  Result<void> finish();

  /// A live scene ends with its present group, unless it has ended already.
  void request_scene() { requested_ = !ended_; }

  /// Whether the next picture begins another scene with the same person. Of a live scene known ahead:
  /// live_scene_ends().
  [[nodiscard]] bool scene_ended() const { return ended_; }
  /// Whether a live scene ends with a group, the last of so many pictures.
  [[nodiscard]] bool live_scene_ends(std::uint64_t pictures) const {
    return key_interval_ > 0 && static_cast<double>(pictures + timing_.group_pictures) > key_interval_;
  }
  /// The surround's map, once after each change.
  [[nodiscard]] std::optional<SurroundMap> take_new_map() { return std::exchange(new_map_, std::nullopt); }

  [[nodiscard]] bool has_several_patterns() const { return second_pass_.has_value(); }
  /// Whole packets that are ready; forgets them.
  [[nodiscard]] std::vector<std::uint8_t> take() { return packets_.take(); }

 private:
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

  MotionTrack motion_;
  std::vector<PictureCost> costs_;        ///< of the group's pictures
  std::vector<std::uint32_t> durations_;  ///< of the same, 1/90000 s; 0: nominal
  std::uint64_t pictures_ = 0;            ///< of the scene
  bool requested_ = false;                ///< the scene ends with its present group
  bool ended_ = false;                    ///< the next picture begins another scene
  StreamPosition position_;               ///< behind the last picture

  MouthColours mouth_colours_;
  SurroundObservations observations_;  ///< empty once the map is final
  bool fixed_ = false;                 ///< whether fix_head() has been called
  bool map_final_ = false;
  SurroundMap map_;
  std::optional<SurroundMap> new_map_;  ///< for the analysis
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
