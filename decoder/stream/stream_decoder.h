// Stream to pictures: feed bytes, take pictures. Memory is bounded by the setup packet's picture size.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bitstream/packet.h"
#include "bitstream/scene/scene_reader.h"
#include "common/result.h"
#include "decoder/draw/pictures_ahead.h"
#include "decoder/draw/renderer.h"
#include "decoder/scene/scene_builder.h"
#include "decoder/stream/late_packets.h"
#include "decoder/stream/sound_inbox.h"
#include "decoder/stream/stream_clock.h"
#include "decoder/stream/stream_tally.h"

namespace fbs {

enum class DecodeStatus : std::uint8_t {
  kPicture,   ///< the next picture's state is known: state(), and render() draws it
  kNeedMore,  ///< feed more bytes, or close()
  kEnd,       ///< the stream is complete
};

/// What a picture has suffered from losses.
enum class PictureQuality : std::uint8_t {
  kExact,           ///< nothing that is known
  kPatternMissing,  ///< a pattern that was sent is missing
  kInterpolated,    ///< its motion is missing, and lies between that before and behind
  kHeld,            ///< it is missing, and the one before is repeated
};

/// Decodes one stream.
///
///   StreamDecoder decoder;
///   decoder.feed(bytes);  decoder.close();
///   while (decoder.next() == DecodeStatus::kPicture && decoder.render(picture)) { ... }
///
/// After an error the next call of next() continues with the first scene after the damage that can be drawn,
/// and returns kEnd when there is none. An error is reported once; everything that depends on a lost packet
/// is left out silently. Where a setup packet or the end packet says that pictures are missing, the last
/// picture is repeated for each of them, so that later pictures keep their numbers and times: at most
/// kMaxHeldPictures in a row (SPEC 6.2).
///
/// A stream may also be joined at any setup packet that keeps no other scene: feed kSignature, then the
/// stream from there on. If it has the head of its scene in parts, it may be joined anywhere: the first
/// picture is one of those that are sent when enough parts have come (SPEC 6.5).
class StreamDecoder {
 public:
  /// Copies `bytes`.
  void feed(std::span<const std::uint8_t> bytes) { packets_.feed(bytes); }
  /// The same with what a packet of a link brings: whole packets of the stream. Some may be missing, come
  /// twice or in another order: LatePackets says which are waited for. One that comes later cannot change
  /// pictures that have been announced, but those behind them are as if it had come in order. Not mixed with
  /// feed(). The signature may be left out. What the link has lost is no error.
  /// @param number  one more for each packet sent, from 0; below 2^64 - 1
  void feed_packet(std::uint64_t number, std::span<const std::uint8_t> bytes);
  /// Packets of the link that are known to be missing and still of use, by rising number.
  /// @param most  how many at most
  [[nodiscard]] std::vector<std::uint64_t> missing_packets(std::size_t most) const {
    return late_.missing(most);
  }
  /// Packets of the link below this number that are missing will not come.
  void give_up_packets(std::uint64_t number) { late_.give_up(number); }
  /// The packets of the link that are missing next are not waited for.
  /// @return whether others have come behind them
  bool skip_missing() { return late_.skip(); }
  /// Whether nothing more is shown, as far as is known, until a scene begins.
  [[nodiscard]] bool needs_scene() const {
    return reader_.lost() || reader_.waits_for_key() || strangers_ > (late_.has_begun() ? 1 : 0);
  }
  /// No more bytes will come.
  void close() { late_.has_begun() ? late_.close() : packets_.close(); }

  /// Counts the bits of motion from the next scene on, which doubles the time to read it. Off by default.
  void count_motion_bits() { tally_.count_motion_bits(); }

  /// Keeps a record of every pattern from now on. Off by default, since records are never dropped.
  void record_patterns() { tally_.record_patterns(); }

  /// Keeps the sound from now on, for take_sound(). Off by default.
  void keep_sound() { sound_.keep(); }
  /// Sound received since the last call. A part comes before its pictures. Parts beyond kMaxSoundAhead are
  /// lost, which next() reports as kTooLarge.
  [[nodiscard]] std::vector<SoundPart> take_sound() { return sound_.take(); }
  /// The scene's last sound setup; nothing if there was none, or an unknown one.
  [[nodiscard]] const std::optional<SoundSetup>& sound_setup() const { return reader_.sound_setup(); }

  /// Refuses streams whose pictures have more pixels, before allocating memory. Unlimited by default.
  void limit_pixels(std::uint64_t max_pixels) { max_pixels_ = max_pixels; }

  /// Threads that draw, at least 1; 1 by default. With more, render() also draws pictures that follow and
  /// whose packets have come, side by side. Pictures are the same, and none is later.
  void use_threads(int threads, const Hooks& hooks = {});

  /// Advances to the next picture. Returns errors of PacketReader and of the payloads, with the byte offset
  /// of the packet; kTruncated when the stream ends inside a packet or before its setup; kInvalidStream when
  /// pictures are missing whose loss no error has reported, or when fewer pictures are announced than have
  /// been shown; kTooLarge when more than kMaxHeldPictures would be held in a row, in which case none is, or
  /// when the picture has more pixels than limit_pixels() allows.
  Result<DecodeStatus> next();

  /// Draws the picture that next() announced last; `out` takes the format's size.
  /// @return kInvalidArgument before the first picture
  [[nodiscard]] Result<void> render(Picture& out);
  /// The same into memory of the caller, whose planes have the format's size.
  [[nodiscard]] Result<void> render(const PictureView& out);

  /// Draws a state of the caller's in the scene of that picture: the view of a user who moves the face. Does
  /// not affect render().
  /// @param state    within the limits of common/state.h
  /// @param pattern  index into scene().patterns: draws from it alone; none: the blend of `state`
  /// @return kInvalidArgument before the first picture, and when there is no such pattern
  [[nodiscard]] Result<void> render_state(const State& state, std::optional<std::size_t> pattern,
                                          Picture& out);
  /// The blend of `state` into memory of the caller, whose planes have the format's size.
  [[nodiscard]] Result<void> render_state(const State& state, const PictureView& out);

  // These describe the picture that next() announced last; a held picture has the state and scene of the one
  // it repeats.
  [[nodiscard]] const State& state() const { return picture_.state; }
  [[nodiscard]] const Scene& scene() const { return picture_.scene ? *picture_.scene : scene_->scene(); }
  [[nodiscard]] const VideoFormat& format() const { return scene().setup.format; }
  /// Number of the picture in the stream, from 0, and its time.
  [[nodiscard]] const StreamPosition& position() const { return picture_.position; }
  /// Its duration in 1/90000 s.
  [[nodiscard]] std::uint32_t duration() const { return picture_.duration; }
  /// Whether the previous picture is repeated in place of a missing one.
  [[nodiscard]] bool held() const { return quality() == PictureQuality::kHeld; }
  /// How far it is what was sent.
  [[nodiscard]] PictureQuality quality() const { return picture_.quality; }

  /// Position of the first picture: not 0, 0 if the stream was joined in its middle.
  [[nodiscard]] const StreamPosition& start() const { return clock_.start(); }
  /// Pictures announced so far, including held ones.
  [[nodiscard]] std::uint64_t pictures() const { return announced_; }
  [[nodiscard]] std::uint64_t held_pictures() const { return clock_.held(); }
  /// Pictures known to be missing between start() and the last setup packet or the end packet, held or not.
  [[nodiscard]] std::uint64_t missing_pictures() const { return clock_.missing(); }
  [[nodiscard]] const ByteCount& bytes() const { return tally_.bytes(); }
  /// Bits of the motion read so far by part; zero unless count_motion_bits() was called.
  [[nodiscard]] const PartBitsX256& motion_bits() const { return tally_.motion_bits(); }
  /// In order of arrival; empty unless record_patterns() was called.
  [[nodiscard]] const std::vector<PatternRecord>& pattern_records() const { return tally_.patterns(); }
  /// Number of pictures announced by the end packet, once it has been read.
  [[nodiscard]] std::optional<std::uint64_t> announced_pictures() const { return end_; }

 private:
  struct Arrived {
    const Packet& packet;
    bool lost;  ///< something of the scene before it is known to be missing
  };

  DecodeStatus show();
  DecodeStatus hold();
  /// Feeds the next packet of the link, or the end of the stream.
  /// @return whether there is one
  bool feed_next();
  /// A packet has no right check: it is damaged, or of a scene whose head is missing.
  /// @return the error; nothing where the link has lost packets that explain it
  std::optional<Error> lose_packet(const Error& error);
  Result<void> take(const Packet& packet);
  // What a packet says.
  Result<void> take(const Setup& setup, const Arrived& arrived);
  Result<void> take(const Return& to, const Arrived& arrived);
  Result<void> take(const End& end, const Arrived& arrived);
  Result<void> take(const Geometry& geometry, const Arrived& arrived);
  Result<void> take(const SurroundMap& surround, const Arrived& arrived);
  Result<void> take(const std::vector<ScenePattern>& patterns, const Arrived& arrived);
  Result<void> take(const MotionGroup& group, const Arrived& arrived);
  static Result<void> take(const BlendGroup& group, const Arrived& arrived);
  Result<void> take(const Unit& unit, const Arrived& arrived) {
    auto taken = take(unit.motion, arrived);
    return taken ? take(unit.blend, arrived) : taken;
  }
  Result<void> take(SoundGroup& group, const Arrived& arrived);
  Result<void> take(const JoinedHead& head, const Arrived& arrived);
  /// Any other is known to the reader alone.
  template <class Syntax>
  Result<void> take(const Syntax& /*syntax*/, const Arrived& /*arrived*/) {
    return {};
  }
  /// @return kUnsupported for another size than before; limits of the caller and of PatternDecoder
  [[nodiscard]] Result<PatternDecoder> decoder_for(const Setup& setup) const;
  /// The clock goes to where the stream says that a scene begins or goes on.
  [[nodiscard]] Result<void> enter(const StreamPosition& before, const Arrived& arrived);
  /// @param reported  whether an error has reported a loss
  [[nodiscard]] Result<void> report_missing(std::uint64_t missing, bool reported) const;

  /// Draws the present picture, or takes it as drawn ahead; has those that follow drawn. There is ahead_.
  [[nodiscard]] Result<Picture> take_ahead();
  void expect_next();

  Renderer renderer_;
  std::unique_ptr<PicturesAhead> ahead_;  ///< null with one thread
  std::uint64_t rendered_ = 0;            ///< pictures() when render() was called last
  std::optional<std::uint64_t> max_pixels_;
  PacketReader packets_;
  LatePackets late_;
  bool unsure_ = false;  ///< packets of the link are missing, and maybe the head of a scene
  int strangers_ = 0;    ///< packets in a row that the scene does not know
  SceneReader reader_;
  StreamClock clock_;
  std::map<std::uint64_t, std::shared_ptr<SceneBuilder>> scenes_;           ///< by SceneReader::scene()
  std::shared_ptr<SceneBuilder> scene_ = std::make_shared<SceneBuilder>();  ///< what packets build
  std::uint64_t announced_ = 0;                                             ///< pictures, held ones too
  struct {
    State state;
    StreamPosition position;
    std::uint32_t duration = 0;  ///< 1/90000 s
    PictureQuality quality{};
    std::shared_ptr<const Scene> scene;
  } picture_;                         ///< announced last
  std::optional<std::uint64_t> end_;  ///< number of pictures, when the end packet has been read
  SoundInbox sound_;
  StreamTally tally_;
};

}  // namespace fbs
