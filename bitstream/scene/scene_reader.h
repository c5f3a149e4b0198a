// Packets to checked syntax: what may follow what, and which pictures a packet releases. SPEC 6.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/motion/motion_decoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
#include "bitstream/scene/head_parts.h"
#include "bitstream/scene/timeline.h"
#include "bitstream/sound_syntax.h"
#include "bitstream/syntax.h"
#include "common/result.h"

namespace fbs {

/// A pattern whose place in the scene has been checked. Its AV1 bytes have not been looked at.
struct ScenePattern {
  PatternSyntax coded;
  State seen;  ///< the state of its picture

  /// Whether it is the scene's first, in whose state the head is at rest.
  [[nodiscard]] bool is_first() const { return coded.picture == 0; }
};

/// The head of a scene whose parts are together: packets that are to be read before any other, from the setup
/// packet on: PacketReader::read_head(). The scene then begins with the present picture.
struct JoinedHead {
  std::vector<std::uint8_t> packets;
};

/// What a packet says. monostate: nothing that can be used, since its type is unknown, it needs something
/// that was lost, it has come before, or it has no effect where it is.
using SceneSyntax = std::variant<std::monostate, Setup, Return, End, std::shared_ptr<const WireFrame>,
                                 Geometry, SurroundMap, std::vector<ScenePattern>, MotionGroup, BlendGroup,
                                 Unit, std::optional<SoundSetup>, SoundGroup, JoinedHead>;

/// Reads the packets of a stream in their order, without pixels.
class SceneReader {
 public:
  /// Reads the next packet. A setup or return packet begins another scene, or goes on with an earlier one, at
  /// once, even if it is refused later on.
  /// @return errors of the payloads, and kInvalidStream for a packet that may not stand where it does; with
  ///         the offset of the packet. An error in a setup packet, a return packet or one that is_of_scene()
  ///         is a loss, as if lose() had been called. Errors in sound do no harm to pictures (SPEC 6.3)
  [[nodiscard]] Result<SceneSyntax> read(const Packet& packet);

  /// Packets are missing. In the head of a scene, up to its first pattern, nothing is of use up to the next
  /// setup or return packet: the scene is lost(). Later on only what needs them is of no use (SPEC 6.2).
  void lose();
  /// Packets may be missing that the link has lost. What needs them is left out, and is no error.
  void note_losses() { has_losses_ = true; }
  /// The scene cannot be used.
  void lose_scene() { lost_ = has_losses_ = true; }
  [[nodiscard]] bool lost() const { return lost_; }
  /// Whether something of the scene is known to be missing.
  [[nodiscard]] bool has_losses() const { return has_losses_; }
  /// Reads again what has been read since `before`, with what had not come then. Pictures that have been
  /// displayed and sound are not repeated.
  /// @param before  this reader as it was, in the same scene
  void go_back(const SceneReader& before);
  /// Whether a pattern that others need is missing.
  [[nodiscard]] bool has_broken_patterns() const { return patterns_.is_broken(); }
  /// Whether groups are left out until a key group comes.
  [[nodiscard]] bool waits_for_key() const { return waits_for_key_; }
  /// A pattern could not be decoded: those that need it are of no use.
  void lose_patterns() {
    has_losses_ = true;
    patterns_.lose();
  }

  /// Whether a setup packet has been read.
  [[nodiscard]] bool has_setup() const { return scene_ > 0; }
  [[nodiscard]] const Setup& setup() const { return setup_; }
  /// Tells the present scene from all others, also after a return to it: scenes are numbered from 1.
  [[nodiscard]] std::uint64_t scene() const { return scene_; }
  /// Whether this is the present scene or one that is set aside.
  [[nodiscard]] bool knows(std::uint64_t scene) const;
  /// What the last sound setup packet says; nothing if there was none since the last setup packet, or none
  /// that is known.
  [[nodiscard]] const std::optional<SoundSetup>& sound_setup() const { return sound_; }

  /// Pictures of the scene: those that packets have released, and those that wait.
  [[nodiscard]] Timeline& pictures() { return pictures_; }
  [[nodiscard]] const Timeline& pictures() const { return pictures_; }

 private:
  [[nodiscard]] Result<SceneSyntax> read_payload(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_setup(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_return(const Packet& packet);
  /// Whether the stream may return to the present scene.
  [[nodiscard]] bool can_return() const { return motion_ && !lost_; }
  /// Sets the present scene aside, if it can_return().
  void set_aside();
  /// @return the last scene that was set aside and has this check; null: there is none
  [[nodiscard]] std::shared_ptr<const SceneReader> take_out(std::uint32_t check);
  /// Goes on with another scene, which takes over what is the stream's.
  void enter(SceneReader scene);
  [[nodiscard]] Result<SceneSyntax> read_geometry(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_wire_frame(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_patterns(const Packet& packet);
  /// Leaves a packet out.
  /// @param needs_missing  not since it came twice or late: a loss if none is known
  [[nodiscard]] Result<SceneSyntax> skip(bool needs_missing) const;
  /// The same for a group of motion or blends.
  [[nodiscard]] Result<SceneSyntax> skip_group(bool needs_key);
  [[nodiscard]] Result<std::optional<ScenePattern>> place(PatternSyntax pattern);
  [[nodiscard]] Result<SceneSyntax> read_head_part(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_motion(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_blend(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_unit(const Packet& packet);
  /// Adds the pictures of a motion payload. @return nothing if it is skipped
  [[nodiscard]] Result<std::optional<MotionGroup>> add_motion(std::span<const std::uint8_t> payload);
  [[nodiscard]] Result<SceneSyntax> read_sound_setup(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_sound(const Packet& packet);

  bool lost_ = false, has_losses_ = false;
  HeadParts head_parts_;   // of a scene that might be joined
  StreamPosition passed_;  // pictures of a scene that is joined next
  // The stream's:
  std::int64_t next_sound_ = 0;  // number of the first frame that has not come
  std::optional<SoundSetup> sound_;
  std::vector<std::shared_ptr<const SceneReader>> aside_;  // scenes that are set aside, in this order
  std::uint64_t scenes_ = 0;                               // so many have begun
  bool earlier_losses_ = false;                            // before the scene, since none was kept
  // The scene's:
  std::uint64_t scene_ = 0;
  Setup setup_;
  std::uint32_t check_ = 0;                      // of its first pattern packet
  std::shared_ptr<const WireFrame> wire_frame_;  // null: the generic head
  PatternPacketReader patterns_;
  std::array<std::int32_t, kMaxPatterns>
      stored_{};                         // picture of the last pattern for each slot; 0: none, or the first
  std::optional<MotionDecoder> motion_;  // from the first pattern on
  std::optional<BlendDecoder> blend_;    // the same, where several patterns are blended
  bool waits_for_key_ = false;
  Timeline pictures_;
};

}  // namespace fbs
