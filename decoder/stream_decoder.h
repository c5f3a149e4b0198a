// Stream to pictures: feed bytes, take pictures. Memory is bounded by the setup packet's picture size.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/motion/motion_bit_counter.h"
#include "bitstream/motion/motion_decoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "common/result.h"
#include "decoder/pattern_decoder.h"
#include "decoder/renderer.h"
#include "decoder/timeline.h"

namespace fbs {

/// Bytes of a stream by what they are for; the parts sum to `total`.
struct ByteCount {
  std::uint64_t total = 0;
  std::uint64_t startup = 0;   ///< prefix that must have arrived before the first picture can be shown
  std::uint64_t geometry = 0;  ///< geometry and surround packets
  std::uint64_t patterns = 0;
  std::uint64_t motion = 0;  ///< motion and blend packets
  std::uint64_t blend = 0;   ///< of `motion`, the blend packets
  std::uint64_t other = 0;   ///< signature, setup, end, unknown packets and skipped bytes
};

/// A pattern as it came.
struct PatternRecord {
  int slot = 0;               ///< index into Scene::patterns, until another pattern comes for the slot
  std::uint64_t picture = 0;  ///< number in the stream of the picture it shows
  std::uint64_t bytes = 0;    ///< of its packet, by the share of its frame in those of the packet
  bool reduced = false;       ///< coded at reduced size
};

enum class DecodeStatus : std::uint8_t {
  kPicture,   ///< the next picture's state is known: state(), and render() draws it
  kNeedMore,  ///< feed more bytes, or close()
  kEnd,       ///< the stream is complete
};

/// Decodes one stream.
///
///   StreamDecoder decoder;
///   decoder.feed(bytes);  decoder.close();
///   while (decoder.next() == DecodeStatus::kPicture && decoder.render(picture)) { ... }
///
/// After an error next() goes on with the first packet behind the damage when it is called again, and returns
/// kEnd when there is none; pictures that were lost are not replaced.
class StreamDecoder {
 public:
  StreamDecoder();

  /// Copies `bytes`.
  void feed(std::span<const std::uint8_t> bytes);
  /// No more bytes will come.
  void close();

  /// Counts the bits of motion from the next scene on, which takes as long again as to read it. Off by
  /// default.
  void count_motion_bits() { counts_motion_bits_ = true; }

  /// Keeps a record of every pattern from now on. Off by default, since records are never dropped.
  void record_patterns() { records_patterns_ = true; }

  /// Goes on to the next picture. Errors are those of PacketReader and of the payloads, with the byte offset
  /// of the packet; kTruncated when the stream ends inside a packet or before its setup.
  Result<DecodeStatus> next();

  /// Draws the picture that next() announced; `out` takes the format's size.
  /// @return kInvalidArgument when there is none: before the first picture of the stream or, behind an error,
  ///         of a new setup
  [[nodiscard]] Result<void> render(Picture& out);
  /// The same into memory of the caller, whose planes have the format's size.
  [[nodiscard]] Result<void> render(const PictureView& out);

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }  ///< valid from the first picture on
  [[nodiscard]] const VideoFormat& format() const { return scene_.setup.format; }
  [[nodiscard]] std::uint64_t pictures() const { return pictures_; }  ///< announced so far
  [[nodiscard]] const ByteCount& bytes() const { return bytes_; }
  /// Bits of the motion read so far by part; zero unless count_motion_bits() was called.
  [[nodiscard]] const PartBitsX256& motion_bits() const { return motion_bits_; }
  /// In the order they came; empty unless record_patterns() was called.
  [[nodiscard]] const std::vector<PatternRecord>& pattern_records() const { return pattern_records_; }
  /// Duration of the announced picture in 1/90000 s.
  [[nodiscard]] std::uint32_t duration() const { return duration_; }
  /// Number of pictures that the end packet announces, when it has been read.
  [[nodiscard]] std::optional<std::uint64_t> announced_pictures() const { return announced_; }

 private:
  Result<void> take(const Packet& packet);
  Result<void> take_setup(const Packet& packet);
  /// A packet of the scene whose loss others depend on: pattern, motion or blend.
  Result<void> take_dependent(const Packet& packet);
  Result<void> take_patterns(const Packet& packet);
  /// @return whether it is coded at reduced size
  Result<bool> take_pattern(const PatternSyntax& pattern);
  Result<void> take_motion(const Packet& packet);
  Result<void> take_blend(const Packet& packet);
  void lose();
  void note_startup();
  void begin_geometry(const State& rest);
  /// Keeps records of the last patterns, which came in one packet.
  void record(const Packet& packet, std::span<const PatternSyntax> patterns,
              const std::vector<bool>& reduced);
  void count(const Packet& packet);

  PacketReader reader_;
  bool damaged_ = false;
  bool missing_setup_reported_ = false;

  Scene scene_;
  bool has_setup_ = false;
  std::optional<Geometry> geometry_;
  std::optional<SurroundMap> surround_;
  PatternPacketReader pattern_packets_;
  std::optional<PatternDecoder> patterns_;
  std::optional<MotionDecoder> motion_;
  bool counts_motion_bits_ = false;
  std::optional<MotionBitCounter> bit_counter_;  ///< of the scene, if bits are counted
  Renderer renderer_;

  std::optional<BlendDecoder> blend_;
  Timeline timeline_;  ///< of the scene
  bool lost_ = false;  ///< a packet of the scene, after its first pattern
  State state_;
  bool announced_picture_ = false;  ///< state_ is one of scene_
  std::uint32_t duration_ = 0;
  std::uint64_t pictures_ = 0;
  std::uint64_t scene_begin_ = 0;  ///< pictures_ before the scene
  bool records_patterns_ = false;
  std::vector<PatternRecord> pattern_records_;
  std::optional<std::uint64_t> announced_;
  ByteCount bytes_;
  PartBitsX256 motion_bits_{};
};

}  // namespace fbs
