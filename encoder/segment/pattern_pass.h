// The second pass over a scene: with pictures analysed and their motion planned, chooses, solves for, codes
// and places the patterns, segment by segment.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "common/workers.h"
#include "decoder/scene/scene.h"
#include "encoder/plan/pattern_point.h"
#include "encoder/segment/pattern_stage.h"
#include "encoder/segment/segment_draft.h"

namespace fbs {

struct PatternPassSettings {
  PatternPoint point{};  ///< where no bitrate is set
  /// Operating point of a quality, 0..100, where a bitrate decides.
  PatternPoint (*point_at)(int quality) = &PatternPoint::at;
  std::size_t count = 0;         ///< patterns of the scene; 0: as the point says
  int groups_per_key = 1;        ///< SceneTiming::groups_per_key
  double bitrate_kbps = 0;       ///< of all packets; 0: the point decides
  double start = 0;              ///< EncoderSettings::start; 0: none
  int lone_quantiser = 40;       ///< for a scene too short for a second pattern
  std::optional<int> quantiser;  ///< of the patterns; empty: as the point says
  std::optional<bool> reduced;   ///< size of the patterns; chosen by rate and distortion
  Effort effort = Effort::of(Effort::kDefault);
  bool without_face = false;  ///< patterns show all motion: often more of them than the decoder keeps at once
  double lambda = 0;          ///< squared luma levels that a bit is worth
  double key_interval = 0;    ///< EncoderSettings::key_interval
  int threads = 1;            ///< at least 1; the stream is the same
  Hooks hooks{};
};

class PatternPass : public PatternStage {
 public:
  /// @param rest  seen state of pattern 0 as coded
  PatternPass(const VideoFormat& format, const PatternPassSettings& settings, const CodedState& rest);

  void begin_scene(const CodedState& rest) override { store_.begin_scene(rest); }
  Result<void> add(const Picture& picture) override;
  void cut() override { store_.cut(); }
  void add(std::span<const State> states, std::vector<std::uint8_t> payload) override {
    store_.add(states, std::move(payload));
  }
  [[nodiscard]] bool segment_ends(std::size_t next) const override;
  [[nodiscard]] std::size_t pictures() const override { return store_.segment().pictures.count(); }
  [[nodiscard]] std::int32_t store() const override { return store_.slots(); }
  [[nodiscard]] Result<std::vector<TypedPayload>> end_segment(Scene& scene, std::size_t other_bytes,
                                                              const StateRefit& refit) override;

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
  /// @param most  at most this many pictures share modes
  Result<void> choose(const Scene& scene, const SegmentDraft& draft, std::size_t most);
  /// Settings for trial coding of patterns.
  [[nodiscard]] SequenceSettings trial_coding(bool reduced) const;
  /// Solves for patterns, codes them, chooses modes and fits states again, as the settings say.
  [[nodiscard]] Result<SegmentDraft> make(const Scene& scene, const StateRefit& refit);
  /// Fits the states again; patterns take the new states of their pictures.
  Result<void> refit_states(const Scene& scene, SegmentDraft& draft, const StateRefit& refit);
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
  /// The segment's packets in stream order; ends it.
  [[nodiscard]] Result<std::vector<TypedPayload>> packets(Scene& scene, const SegmentDraft& draft);

  PatternPassSettings settings_;
  Workers workers_;
  SegmentStore store_;
  std::int32_t most_;                     ///< patterns in a segment
  double left_bytes_ = 0;                 ///< of the rate, left over by earlier segments; negative: overspent
  std::optional<SequencePattern> start_;  ///< of the segment: SegmentDraft::start
  bool begun_ = false;                    ///< the stream has a pattern
  cv::Mat shot_first_;                    ///< of the last shot's pictures in the segment, reduced luma
  // Operating point of the segment: from the settings, or to meet the bitrate.
  PatternPoint point_;
  SequenceSettings coding_;
};

}  // namespace fbs
