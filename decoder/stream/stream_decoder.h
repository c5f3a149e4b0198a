// Stream to pictures: feed bytes, take pictures. Memory is bounded by the setup packet's picture size.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/motion/motion_bit_counter.h"
#include "bitstream/motion/motion_decoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/sound_syntax.h"
#include "common/result.h"
#include "decoder/draw/renderer.h"
#include "decoder/pattern/pattern_decoder.h"
#include "decoder/stream/stream_clock.h"
#include "decoder/stream/timeline.h"

namespace fbs {

/// Bytes of a stream by what they are for; the parts sum to `total`.
struct ByteCount {
  std::uint64_t total = 0;
  std::uint64_t startup = 0;   ///< prefix that must have arrived before the first picture can be shown
  std::uint64_t geometry = 0;  ///< geometry and surround packets
  std::uint64_t patterns = 0;
  std::uint64_t motion = 0;  ///< motion and blend packets
  std::uint64_t blend = 0;   ///< of `motion`, the blend packets
  std::uint64_t sound = 0;   ///< sound packets and their setups
  std::uint64_t other = 0;   ///< signature, setup, end, unknown packets and skipped bytes
};

/// Sound as it came.
struct SoundPart {
  SoundSetup setup;
  SoundGroup group;
};

/// Most of the sound that waits for its pictures, memory_of(): an hour and a half of speech. Streams that
/// have more of it before a picture are none of an encoder.
inline constexpr std::size_t kMaxSoundAhead = std::size_t{1} << 24;

/// About what a frame of sound takes, and a group; bytes.
[[nodiscard]] std::size_t memory_of(const std::vector<std::uint8_t>& frame);
[[nodiscard]] std::size_t memory_of(const SoundGroup& group);

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
/// After an error next() goes on with the first scene behind the damage when it is called again, and returns
/// kEnd when there is none. An error is reported once; what depends on a lost packet is left out in silence.
/// Where a setup packet or the end packet says that pictures are missing, the last picture is shown again for
/// each of them, so that the pictures behind keep their numbers and times: at most kMaxHeldPictures in a row
/// (SPEC 6.2).
///
/// A stream may also be joined at any setup packet: feed kSignature, then the stream from there on.
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

  /// Keeps the sound from now on, for take_sound(). Off by default.
  void keep_sound() { keeps_sound_ = true; }
  /// Sound that has come since the last call. A part comes before the pictures that it belongs to. Parts
  /// beyond kMaxSoundAhead are lost, which next() reports as kTooLarge.
  [[nodiscard]] std::vector<SoundPart> take_sound() {
    sound_size_ = 0;
    return std::exchange(sound_parts_, {});
  }
  /// Of the scene: what its last sound setup packet says; nothing if there was none, or none that we know.
  [[nodiscard]] const std::optional<SoundSetup>& sound_setup() const { return sound_; }

  /// Refuses streams whose pictures have more pixels, before memory is taken for them. Unlimited by default.
  void limit_pixels(std::uint64_t max_pixels) { max_pixels_ = max_pixels; }

  /// Threads that share the drawing of each picture, at least 1; 1 by default. Pictures are the same.
  void use_threads(int threads) { renderer_ = Renderer(threads); }

  /// Goes on to the next picture. Errors are those of PacketReader and of the payloads, with the byte offset
  /// of the packet; kTruncated when the stream ends inside a packet or before its setup; kInvalidStream when
  /// pictures are missing of whose loss no error has told, or when fewer pictures are announced than have
  /// been shown; kTooLarge when more than kMaxHeldPictures would be held in a row: none of them is; or when
  /// the picture has more pixels than limit_pixels() allows.
  Result<DecodeStatus> next();

  /// Draws the picture that next() announced last; `out` takes the format's size.
  /// @return kInvalidArgument before the first picture
  [[nodiscard]] Result<void> render(Picture& out);
  /// The same into memory of the caller, whose planes have the format's size.
  [[nodiscard]] Result<void> render(const PictureView& out);

  /// Draws a state of the caller's in the scene of that picture: what a viewer sees who moves the face.
  /// Leaves alone what render() draws. A held picture whose scene is not kept any more is drawn as it is.
  /// @param state    within the limits of common/state.h
  /// @param pattern  index into scene().patterns: draws from it alone; none: the blend of `state`
  /// @return kInvalidArgument before the first picture, and when there is no such pattern
  [[nodiscard]] Result<void> render_state(const State& state, std::optional<std::size_t> pattern,
                                          Picture& out);
  /// The blend of `state` into memory of the caller, whose planes have the format's size.
  [[nodiscard]] Result<void> render_state(const State& state, const PictureView& out);

  // Of the picture that next() announced last; a held picture has the state and scene of the one it repeats.
  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const Scene& scene() const { return shown_scene_ ? *shown_scene_ : scene_; }
  [[nodiscard]] const VideoFormat& format() const { return scene().setup.format; }
  /// Number of the picture in the stream, from 0, and its time.
  [[nodiscard]] const StreamPosition& position() const { return position_; }
  /// Its duration in 1/90000 s.
  [[nodiscard]] std::uint32_t duration() const { return duration_; }
  /// Whether the picture before is shown again, in the place of one that is missing.
  [[nodiscard]] bool held() const { return held_; }

  /// Position of the first picture: not 0, 0 if the stream was joined in its middle.
  [[nodiscard]] const StreamPosition& start() const { return clock_.start(); }
  /// Announced so far, held ones too.
  [[nodiscard]] std::uint64_t pictures() const { return pictures_; }
  [[nodiscard]] std::uint64_t held_pictures() const { return clock_.held(); }
  /// Known to be missing between start() and the last setup packet or the end packet, whether held or not.
  [[nodiscard]] std::uint64_t missing_pictures() const { return clock_.missing(); }
  [[nodiscard]] const ByteCount& bytes() const { return bytes_; }
  /// Bits of the motion read so far by part; zero unless count_motion_bits() was called.
  [[nodiscard]] const PartBitsX256& motion_bits() const { return motion_bits_; }
  /// In the order they came; empty unless record_patterns() was called.
  [[nodiscard]] const std::vector<PatternRecord>& pattern_records() const { return pattern_records_; }
  /// Number of pictures that the end packet announces, when it has been read.
  [[nodiscard]] std::optional<std::uint64_t> announced_pictures() const { return announced_; }

 private:
  struct NextScene {
    Setup setup;
    PatternDecoder patterns;
  };

  struct Arrival {
    std::size_t slot;
    Pattern pattern;
  };
  static constexpr std::size_t kMaxArrivals = 4;

  DecodeStatus show(const Timeline::Entry& picture);
  DecodeStatus hold();
  Result<void> take(const Packet& packet);
  Result<void> take_setup(const Packet& packet);
  Result<void> take_end(const Packet& packet);
  /// Any other packet.
  Result<void> take_of_scene(const Packet& packet);
  /// @param reported  whether an error has told of a loss
  [[nodiscard]] Result<void> report_missing(std::uint64_t missing, bool reported, const Packet& packet) const;
  void begin_scene();
  /// Keeps the last picture as it is drawn now: the store changes.
  Result<void> keep_picture();
  /// Puts a pattern into the store, or has it wait as long as the last picture may be drawn again.
  Result<void> store(std::size_t slot, Pattern pattern);
  void store_arrivals();
  Result<void> take_patterns(const Packet& packet);
  /// @return whether it is coded at reduced size
  Result<bool> take_pattern(const PatternSyntax& pattern);
  Result<void> take_motion(const Packet& packet);
  Result<void> take_blend(const Packet& packet);
  Result<void> take_sound_setup(const Packet& packet);
  Result<void> take_sound(const Packet& packet);
  void lose();
  void note_startup();
  void begin_geometry();
  Result<void> take_surround(const Packet& packet);
  /// Keeps records of the last patterns, which came in one packet.
  void record(const Packet& packet, std::span<const PatternSyntax> patterns,
              const std::vector<bool>& reduced);
  void count(const Packet& packet);

  PacketReader reader_;
  bool damaged_ = false;  ///< the reader has to search
  bool missing_setup_reported_ = false;

  StreamClock clock_;
  std::optional<NextScene> next_scene_;  ///< begins when the clock is not behind
  Scene scene_;                          ///< of the last setup packet
  std::size_t slots_ = 0;                ///< that its patterns fill, with those that have yet to come into it
  bool has_setup_ = false;
  std::shared_ptr<const WireFrame> wire_frame_;  // of the scene; null: the generic head
  std::optional<Geometry> geometry_;
  SurroundMap surround_ = still_surround();
  State rest_;  ///< in which the scene's first pattern was seen
  PatternPacketReader pattern_packets_;
  std::optional<PatternDecoder> patterns_;
  std::optional<MotionDecoder> motion_;
  std::optional<std::uint64_t> max_pixels_;
  bool counts_motion_bits_ = false;
  std::optional<MotionBitCounter> bit_counter_;  ///< of the scene, if bits are counted
  Renderer renderer_;

  std::optional<BlendDecoder> blend_;
  Timeline timeline_;  ///< of the scene
  bool lost_ = false;  ///< a packet since the last setup packet

  // The picture that was announced last.
  State state_;
  std::optional<Scene> shown_scene_;  ///< its scene, if that is not scene_
  std::optional<Scene> kept_;         ///< shows it, if what it was drawn from has changed
  /// Come into the store with the next picture; a picture is only kept when there are too many.
  std::vector<Arrival> arrivals_;
  StreamPosition position_;
  std::uint32_t duration_ = 0;
  bool held_ = false;

  std::optional<SoundSetup> sound_;  ///< of the scene
  std::int64_t next_sound_ = 0;      ///< number of the first frame that has not come
  bool keeps_sound_ = false;
  std::vector<SoundPart> sound_parts_;
  std::size_t sound_size_ = 0;  ///< memory_of() them

  std::uint64_t pictures_ = 0;
  bool records_patterns_ = false;
  std::vector<PatternRecord> pattern_records_;
  std::optional<std::uint64_t> announced_;
  ByteCount bytes_;
  PartBitsX256 motion_bits_{};
};

}  // namespace fbs
