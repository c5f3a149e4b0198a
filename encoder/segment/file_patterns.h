// The second pass over a scene: with pictures analysed and their motion planned, chooses, solves for, codes
// and places the patterns, segment by segment.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "common/workers.h"
#include "decoder/scene/scene.h"
#include "encoder/plan/pattern_point.h"
#include "encoder/segment/pattern_stage.h"
#include "encoder/segment/segment_draft.h"

namespace fbs {

struct FilePatternSettings : PatternSettings {
  PatternPoint point{};  ///< where no bitrate is set
  /// Operating point of a quality, 0..100, where a bitrate decides.
  PatternPoint (*point_at)(int quality) = &PatternPoint::at;
  std::size_t count = 0;         ///< patterns of the scene; 0: as the point says
  int lone_quantiser = 40;       ///< for a scene too short for a second pattern
  std::optional<int> quantiser;  ///< of the patterns; empty: as the point says
  std::optional<bool> reduced;   ///< size of the patterns; chosen by rate and distortion
  Effort effort = Effort::of(Effort::kDefault);
  bool without_face = false;  ///< patterns show all motion: often more of them than the decoder keeps at once
};

class FilePatterns : public PatternPolicy {
 public:
  FilePatterns(PatternStage& stage, const FilePatternSettings& settings);

  void note_added(const Picture& picture) override;
  [[nodiscard]] bool segment_ends(std::size_t next) const override;
  [[nodiscard]] Result<SegmentDraft> make_segment(const Scene& scene, std::size_t other_bytes,
                                                  const StateRefit& refit) override;
  void end_segment(std::vector<TypedPayload>& packets) override {
    left_bytes_ -= static_cast<double>(bytes_of(packets));
  }

 private:
  /// A draft of the pictures that are to become patterns.
  [[nodiscard]] Result<SegmentDraft> draft() const;
  /// Error of the pictures between lossless patterns.
  [[nodiscard]] Result<double> loss_between(const Scene& scene);
  /// Pictures of the segment that are to become patterns.
  [[nodiscard]] std::vector<std::size_t> times_wanted() const;
  /// Decides whether patterns are coded at half width and height.
  Result<void> choose_size(const Scene& scene);
  [[nodiscard]] Result<bool> reduced_size_pays(const Scene& scene);
  /// Consecutive patterns from the middle of the segment.
  [[nodiscard]] Result<std::vector<Picture>> trial_pictures(std::span<const std::size_t> times);
  /// Settings for trial coding of patterns.
  [[nodiscard]] SequenceSettings trial_coding(bool reduced) const;
  [[nodiscard]] int quantiser_at(bool reduced) const;
  void set_size(bool reduced);
  /// The highest quality at which the segment, by quick trials, takes no more than `bytes`.
  [[nodiscard]] Result<int> quality_for(const Scene& scene, double bytes);
  /// Sets quality and size for this many bytes.
  Result<void> aim(const Scene& scene, double bytes);
  /// Makes a coarse first pattern where that of the segment is not there in time.
  /// @param bytes  of the segment
  /// @param other_bytes  written before it
  Result<void> begin_coarse(const Scene& scene, double bytes, double other_bytes);
  /// Codes the patterns again with other quantisers until the segment takes this many bytes, within a few
  /// percent.
  Result<void> meet(const Scene& scene, double bytes, SegmentDraft& draft);
  /// All packets of the segment.
  [[nodiscard]] Result<double> taken_by(const Setup& setup, const SegmentDraft& draft) const;

  FilePatternSettings settings_;
  std::int32_t most_;                     ///< patterns in a segment
  double left_bytes_ = 0;                 ///< of the rate; negative: overspent
  std::optional<SequencePattern> start_;  ///< of the segment: SegmentDraft::start
  cv::Mat shot_first_;                    ///< of the last shot's pictures in the segment, reduced luma
  // Operating point of the segment: from the settings, or to meet the bitrate.
  PatternPoint point_;
  SequenceSettings coding_;
};

}  // namespace fbs
