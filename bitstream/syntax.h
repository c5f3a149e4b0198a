// The content of packets as plain data. SPEC.md defines how each is coded.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "bitstream/coded_state.h"
#include "common/generic_head.h"
#include "common/picture.h"
#include "common/state.h"

namespace fbs {

inline constexpr int kFormatVersion = 9;  ///< the newest
/// As the newest, but no scene is kept. Written wherever that is so: decoders of that version can read it.
inline constexpr int kVersionWithoutReturns = 8;
inline constexpr int kMaxGroupPictures = 256;  ///< pictures in one motion packet
/// Probability that a group is not key, 1/65536. It is fixed, since a key group resets all contexts.
inline constexpr std::uint32_t kNotKey = 15 << 12;
inline constexpr int kContrastOneLog2 = 8;
inline constexpr int kContrastOne = 1 << kContrastOneLog2;  ///< contrast of patterns as they are
inline constexpr int kMinContrast = 128;
inline constexpr int kMaxChromaContrast = 2 * kContrastOne;
inline constexpr int kMaxPatterns = 64;  ///< patterns that a decoder keeps
inline constexpr int kNumberBits = 10;   ///< of the number of a group's first picture that are sent
/// Missing pictures through which the motion goes on; before them the last known state is held. SPEC 6.2.
inline constexpr std::int32_t kMaxBridged = 32;
inline constexpr std::uint64_t kMaxPictureNumber = (1u << 31) - 1;  ///< of a picture in its scene
inline constexpr int kMaxWaitingPictures = 4096;  ///< pictures whose motion has arrived but not their blend
inline constexpr int kKeptPictures = 256;      ///< displayed pictures whose states a pattern may still have
inline constexpr std::size_t kKeptScenes = 3;  ///< besides the present one, to which a stream may return
inline constexpr std::size_t kMaxHead = std::size_t{1} << 16;  ///< bytes of a head that is sent in parts
inline constexpr int kMaxHeadSymbols = 128, kMaxHeadParts = 255;
inline constexpr std::uint64_t kMaxPassedPictures = 1u << 30;  ///< of a scene that is joined
inline constexpr int kMaxSurroundCells = 128;  ///< columns and rows of the surround's grid, each
inline constexpr std::uint32_t kMaxDuration = 60 * kTicksPerSecond;  ///< of one picture, 1/90000 s

inline constexpr std::uint64_t kMaxStreamPictures = std::uint64_t{1} << 40;
inline constexpr std::uint64_t kMaxStreamTime = std::uint64_t{1} << 53;  ///< 1/90000 s: 3000 years
/// How often a decoder repeats a picture in place of lost ones. SPEC 6.2.
inline constexpr std::uint64_t kMaxHeldPictures = std::uint64_t{1} << 14;

/// A place between two pictures of a stream: the sums of what comes before it.
struct StreamPosition {
  std::uint64_t pictures = 0;  ///< 0..kMaxStreamPictures
  std::uint64_t time = 0;      ///< sum of their durations in 1/90000 s, 0..kMaxStreamTime
  friend bool operator==(const StreamPosition&, const StreamPosition&) = default;

  /// Advances past a picture.
  constexpr void add(std::uint32_t duration) {
    ++pictures;
    time += duration;
  }
};

/// Whether this many pictures can take this long: each has a duration of 1..kMaxDuration.
/// @param pictures  at most kMaxStreamPictures
/// @param time      1/90000 s
[[nodiscard]] constexpr bool can_last(std::uint64_t pictures, std::uint64_t time) {
  return time >= pictures && time <= pictures * kMaxDuration;
}

/// Duration of a picture in a group without durations, 1..kMaxDuration in 1/90000 s. SPEC 5.5.
/// @param rate  pictures per second; not zero
[[nodiscard]] constexpr std::uint32_t nominal_duration(const Rational& rate) {
  const std::uint64_t duration = (std::uint64_t{kTicksPerSecond} * rate.den + rate.num / 2) / rate.num;
  return static_cast<std::uint32_t>(duration < 1 ? 1 : duration > kMaxDuration ? kMaxDuration : duration);
}

inline constexpr int kFollowOne = 4;  ///< weight of a surround point that follows a motion entirely

enum class PacketType : std::uint8_t {
  kSetup = 1,       ///< begins a scene, where a viewer can join
  kGeometry = 2,    ///< the adapted head; absent in a scene without a face
  kSurround = 3,    ///< the motion that each point of the surround follows
  kPattern = 4,     ///< one coded picture and its seen state
  kMotion = 5,      ///< the states of a group of pictures
  kEnd = 6,         ///< number of pictures of the stream
  kBlend = 7,       ///< how consecutive pictures are blended from patterns
  kWireFrame = 8,   ///< the wire-frame of the geometry that follows, in the place of the generic head
  kSoundSetup = 9,  ///< what a decoder of the sound must know
  kSound = 10,      ///< sound of the pictures that follow
  kUnit = 11,       ///< kMotion and kBlend of the same pictures
  kHeadPart = 12,   ///< of what a viewer needs who joins a scene
  kReturn = 13      ///< goes on with an earlier scene
};

/// A colour in the video's own range and matrix.
struct YuvColour {
  std::uint8_t y = 128, u = 128, v = 128;
  friend bool operator==(const YuvColour&, const YuvColour&) = default;
};

/// Colours of the mouth interior where the pattern shows closed lips: at the upper lip (teeth) and at the
/// lower lip (dark, tongue); their mean lies half way. State::interior is added to their luma.
struct MouthInterior {
  YuvColour upper{70, 126, 138}, lower{45, 126, 138};
  friend bool operator==(const MouthInterior&, const MouthInterior&) = default;
};

/// Which scenes the stream may return to. SPEC 6.6.
enum class SceneKeeping : std::uint8_t {
  kNone,        ///< none of those before
  kAside,       ///< those that have been set aside
  kAndPresent,  ///< those, and the present one, which is set aside, too
};

/// Begins a scene. All later packets of the scene depend on it.
struct Setup {
  StreamPosition before;  ///< where the scene begins; can_last() is true
  VideoFormat format;
  QuantiserSteps steps;
  PartMask parts = kAllParts;  ///< parts of the state that are sent; always with the pose
  MouthInterior mouth;
  std::int32_t patterns = 1;  ///< kept by the decoder, 1..kMaxPatterns; 1: pictures need no blend packets
  std::int32_t contrast = kContrastOne;  ///< of patterns' luma outside the face, kMinContrast..kContrastOne
  /// Contrast of the patterns' chroma, kContrastOne..kMaxChromaContrast, even.
  std::int32_t chroma_contrast = kContrastOne;
  /// What becomes of the scenes before it. Where they are kept the stream may return to them, so a viewer
  /// does not join here.
  SceneKeeping keeps = SceneKeeping::kNone;
  friend bool operator==(const Setup&, const Setup&) = default;
};

/// Goes on with a scene that is kept.
struct Return {
  std::uint32_t scene = 0;  ///< check of its first pattern packet, 16 or 24 bits
  StreamPosition before;    ///< where in the stream it goes on; can_last() is true
  bool aside = false;       ///< the present scene is set aside; otherwise it is discarded
  /// Pictures of the scene that were to be shown before: those of them that wait, since something is lost,
  /// are not shown any more. At most kMaxPictureNumber.
  std::uint32_t passed = 0;
  friend bool operator==(const Return&, const Return&) = default;
};

/// The adapted head: position of each vertex of the wire-frame for this face, expressionless. Head units.
struct Geometry {
  std::vector<glm::ivec3> positions = std::vector<glm::ivec3>(kVertexCount);  ///< within +-kMaxCoordinate
  std::shared_ptr<const WireFrame> own_frame;                                 ///< null: the generic head
  [[nodiscard]] const WireFrame& wire_frame() const { return own_frame ? *own_frame : generic_head(); }
  friend bool operator==(const Geometry&, const Geometry&) = default;
};

/// A regular grid of (columns + 1) x (rows + 1) points over the picture, the outermost near its borders. Each
/// point has a weight for the head's motion and, in the remainder, one for the body's; the rest follows the
/// ground. SPEC 10.1.
struct SurroundMap {
  std::int32_t columns = 0;  ///< 1..kMaxSurroundCells
  std::int32_t rows = 0;
  std::vector<std::uint8_t> head;  ///< row by row from the top: 0 .. kFollowOne (hair, ears)
  std::vector<std::uint8_t> body;  ///< 0 (ground) .. kFollowOne (shoulders); 0 where head is kFollowOne
  friend bool operator==(const SurroundMap&, const SurroundMap&) = default;
};

/// One pattern: a coded picture, and the picture of the scene that it shows.
struct PatternSyntax {
  std::int32_t slot = 0;          ///< place in the decoder's store, 0..patterns of the setup - 1
  std::int32_t picture = 0;       ///< number of the picture in the scene, whose state is the seen state
  CodedState state{};             ///< of picture 0 only, which is coded before all motion
  std::vector<std::uint8_t> av1;  ///< one coded AV1 frame (low-overhead OBU format)
  bool alone = false;             ///< it needs the scene's first pattern and no other
  friend bool operator==(const PatternSyntax&, const PatternSyntax&) = default;
};

/// Numbers of one part at one picture of a group, interpolated linearly between knots. Not a knot or control
/// point of the B-splines that mark the features of the face.
struct Knot {
  std::int32_t picture = 0;                        ///< 0 .. pictures of the group - 1
  std::array<std::int32_t, kMaxPartSize> value{};  ///< in steps; the part's numbers, then zeros
  friend bool operator==(const Knot&, const Knot&) = default;
};

/// The motion of one part through a group: linear from knot to knot.
using Track = std::vector<Knot>;

/// Consecutive pictures.
struct MotionGroup {
  bool key = false;           ///< coded without reference to earlier groups
  std::int32_t first = 0;     ///< number of its first picture in the scene
  std::int32_t missing = 0;   ///< pictures before it whose groups have not come; 0 for who writes
  CodedState anchor{};        ///< state before them: of the last picture of the group before or, if there is
                              ///< none, of the first pattern. Not coded
  bool unsure = false;        ///< the reader has joined, and does not know all of the anchor
  std::int32_t pictures = 0;  ///< 1..kMaxGroupPictures
  /// Each part that is sent has at least one knot, the last in the last picture; the others have none.
  std::array<Track, kPartCount> tracks;
  std::uint32_t missing_time = 0;  ///< of the missing pictures together, 1/90000 s
  std::vector<std::uint32_t>
      durations;  ///< of each picture, 1..kMaxDuration, 1/90000 s; empty: constant frame rate
  friend bool operator==(const MotionGroup&, const MotionGroup&) = default;
};

/// How consecutive pictures are blended.
struct BlendGroup {
  bool key = false;                ///< coded without reference to earlier groups
  std::int32_t first = 0;          ///< number of its first picture in the scene
  std::int32_t missing = 0;        ///< pictures before it whose groups have not come; 0 for who writes
  std::vector<RegionModes> modes;  ///< of each picture, 1..kMaxGroupPictures
  friend bool operator==(const BlendGroup&, const BlendGroup&) = default;
};

/// A group's states and modes in one packet.
struct Unit {
  MotionGroup motion;
  BlendGroup blend;  ///< of the same pictures
};

/// A part of the head of a scene, of its packets up to the first pattern. Any `symbols` different parts make
/// it whole.
struct HeadPart {
  std::uint16_t scene = 0;  ///< the low bits of the check of its first pattern packet
  StreamPosition passed;    ///< pictures of the scene before it, all released; at most kMaxPassedPictures
  std::size_t size = 0;     ///< bytes of the head, 1..kMaxHead
  int symbols = 1;          ///< pieces of equal size that the head is divided into, 1..kMaxHeadSymbols
  int index = 0;            ///< of the part, 0..kMaxHeadParts - 1
  std::vector<std::uint8_t> symbol;  ///< symbol_size() bytes

  [[nodiscard]] std::size_t symbol_size() const {
    const auto n = static_cast<std::size_t>(symbols);
    return (size + n - 1) / n;
  }
  friend bool operator==(const HeadPart&, const HeadPart&) = default;
};

/// Closes a complete file.
struct End {
  std::uint64_t pictures = 0;  ///< of the stream, 0..kMaxStreamPictures
  friend bool operator==(const End&, const End&) = default;
};

}  // namespace fbs
