// Patterns of a live scene: sent when they pay for past pictures, without look-ahead.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/workers.h"
#include "decoder/pattern/pattern_decoder.h"
#include "encoder/patterns/av1_encoder.h"
#include "encoder/plan/live_rate.h"
#include "encoder/plan/pattern_regret.h"
#include "encoder/segment/pattern_stage.h"
#include "encoder/segment/segment_blend.h"
#include "encoder/segment/segment_store.h"

namespace fbs {

struct LivePatternSettings {
  int quantiser = 58;       ///< libaom's scale, 0..63; for all patterns but a scene's first
  bool reduced = false;     ///< patterns are coded at half width and height
  double lambda = 0;        ///< squared luma levels that a bit of blend modes is worth
  bool refits = true;       ///< states are fitted to the blend
  double bitrate_kbps = 0;  ///< of all packets; 0: the quantiser decides
  double buffer = 0;        ///< LiveSettings::buffer
  int groups_per_key = 1;   ///< SceneTiming::groups_per_key
  bool alone = false;       ///< each pattern needs the first alone
  int threads = 1;          ///< at least 1; the stream is the same
};

/// Each group is a segment: its packets are ready as soon as its pictures are known. A pattern shows the last
/// picture of its group, or the first of another shot, and is used from that group on.
class LivePatterns : public PatternStage {
 public:
  /// @param rest  seen state of pattern 0 as coded
  LivePatterns(const VideoFormat& format, const LivePatternSettings& settings, const CodedState& rest);

  void begin_scene(const CodedState& rest) override;
  void set_bitrate(double kbps) override {
    if (rate_) rate_->set(kbps);
  }
  void lose_patterns() override;
  Result<void> add(const Picture& picture) override { return store_.add(picture); }
  void cut() override { store_.cut(); }
  void add(std::span<const State> states, std::vector<std::uint8_t> payload) override {
    store_.add(states, std::move(payload));
  }
  [[nodiscard]] bool segment_ends(std::size_t /*next*/) const override { return true; }
  [[nodiscard]] std::size_t pictures() const override { return store_.segment().pictures.count(); }
  [[nodiscard]] std::int32_t store() const override { return store_.slots(); }
  [[nodiscard]] Result<std::vector<TypedPayload>> end_segment(Scene& scene, std::size_t other_bytes,
                                                              const StateRefit& refit) override;

 private:
  /// A pattern of the segment.
  struct Sent {
    std::size_t time;  ///< picture of the segment that it shows
    std::size_t slot;
    std::vector<std::uint8_t> av1;
    Picture decoded;
  };
  /// Picture of the segment that a pattern would show.
  [[nodiscard]] std::size_t pattern_time() const;
  /// Predicted bits of a pattern: those of the last one like it.
  struct Size {
    double bits = 0;
    int quantiser = 0;
    [[nodiscard]] double at(int other_quantiser) const;
  };
  /// The quantiser to code the scene's first pattern with.
  [[nodiscard]] Result<int> key_quantiser();
  /// The quantiser to code another pattern with; nothing: none is needed, or none can be sent.
  /// @param shared  unknown errors are shared by at most this many pictures
  [[nodiscard]] Result<std::optional<int>> later_quantiser(const Scene& scene, std::size_t shared);
  /// The finest quantiser, no finer than `from`, at which a pattern may be sent now; nothing: even the
  /// coarsest takes too much.
  [[nodiscard]] std::optional<int> affordable(const Size& size, int from) const;
  /// The size at which patterns are coded.
  [[nodiscard]] VideoFormat coded_format() const;
  /// libaom's speed for the next pattern: hasty where many have been coded lately.
  [[nodiscard]] int speed() const;
  /// Begins an AV1 sequence.
  Result<void> open(int quantiser, int speed);
  /// Codes a pattern, as the decoder will have it.
  struct Coded {
    std::vector<std::uint8_t> av1;
    Picture decoded;
  };
  [[nodiscard]] Result<Coded> code(const Picture& picture);
  /// Codes a picture of the segment.
  [[nodiscard]] Result<Sent> code(const Scene& scene, std::size_t time, int quantiser);
  /// Records the bytes of a pattern.
  void learn(std::size_t bytes, int quantiser);
  /// Puts the pattern into the store, seen in its picture's present state.
  void place(Scene& scene, const Sent& sent);
  [[nodiscard]] SegmentPatterns usable(const Scene& scene) const;
  /// Computes errors_ if they are unknown.
  /// @param shared  by at most this many pictures
  Result<void> measure(const Scene& scene, std::size_t shared);
  /// Sets the blend modes of the segment.
  Result<void> choose(const Scene& scene, std::size_t shared);
  /// Makes a pattern at this quantiser, if any, and sets states and blend modes.
  /// @param refit  empty: states stay as they are
  [[nodiscard]] Result<std::optional<Sent>> make(Scene& scene, std::optional<int> quantiser,
                                                 const StateRefit& refit);
  [[nodiscard]] Result<std::vector<TypedPayload>> packets(const Setup& setup,
                                                          const std::optional<Sent>& sent);

  /// An AV1 sequence, and what the decoder makes of it.
  struct Codec {
    Av1Encoder encoder;
    PatternDecoder decoder;
  };

  LivePatternSettings settings_;
  Workers workers_;
  SegmentStore store_;
  std::optional<LiveRate> rate_;
  Size key_, later_;         ///< of a whole picture, and of one that others predict
  double coded_lately_ = 0;  ///< patterns, less those for which there has been time since
  // The scene's:
  std::optional<Codec> codec_;
  struct First {
    Picture picture;
    int quantiser, speed;
  } first_;     ///< pattern, as it was coded
  bool alone_;  ///< LivePatternSettings::alone, or a pattern has been lost
  PatternRegret regret_;
  RegionModes modes_{};  ///< of the last picture
  std::size_t next_slot_ = 0;
  SegmentErrors errors_;  ///< empty: unknown, as states or patterns have changed
};

}  // namespace fbs
