// Packets to checked syntax: what may follow what, and which pictures a packet releases. SPEC 6.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "bitstream/blend/blend_coder.h"
#include "bitstream/motion/motion_decoder.h"
#include "bitstream/packet.h"
#include "bitstream/pattern/pattern_packet.h"
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

/// What a packet says. monostate: nothing that can be used, since its type is unknown, something was lost
/// before it, or it has no effect where it is.
using SceneSyntax =
    std::variant<std::monostate, Setup, End, std::shared_ptr<const WireFrame>, Geometry, SurroundMap,
                 std::vector<ScenePattern>, MotionGroup, BlendGroup, std::optional<SoundSetup>, SoundGroup>;

/// Whether a packet counts for the pictures of a scene: an error in it loses the rest of the scene.
[[nodiscard]] bool is_of_scene(PacketType type);

/// Reads the packets of a stream in their order, without pixels.
class SceneReader {
 public:
  /// Reads the next packet. A setup packet begins another scene at once, even if it is refused later on.
  /// @return errors of the payloads, and kInvalidStream for a packet that may not stand where it does; with
  ///         the offset of the packet. After an error in a setup packet or one that is_of_scene(), the scene
  ///         is lost(). Errors in sound do no harm to pictures (SPEC 6.3)
  [[nodiscard]] Result<SceneSyntax> read(const Packet& packet);

  /// Something is missing: nothing is of use up to the next setup packet (SPEC 6.2).
  void lose() { lost_ = true; }
  [[nodiscard]] bool lost() const { return lost_; }

  /// Whether a setup packet has been read.
  [[nodiscard]] bool has_setup() const { return has_setup_; }
  [[nodiscard]] const Setup& setup() const { return setup_; }
  /// What the scene's last sound setup packet says; nothing if there was none, or none that is known.
  [[nodiscard]] const std::optional<SoundSetup>& sound_setup() const { return sound_; }

  /// Pictures of the scene: those that packets have released, and those that wait.
  [[nodiscard]] Timeline& pictures() { return pictures_; }
  [[nodiscard]] const Timeline& pictures() const { return pictures_; }

 private:
  [[nodiscard]] Result<SceneSyntax> read_payload(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_setup(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_geometry(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_wire_frame(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_patterns(const Packet& packet);
  [[nodiscard]] Result<ScenePattern> place(PatternSyntax pattern);
  [[nodiscard]] Result<SceneSyntax> read_motion(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_blend(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_sound_setup(const Packet& packet);
  [[nodiscard]] Result<SceneSyntax> read_sound(const Packet& packet);

  bool has_setup_ = false;
  bool lost_ = false;
  std::int64_t next_sound_ = 0;  // number of the first frame that has not come
  // Of the scene:
  Setup setup_;
  std::shared_ptr<const WireFrame> wire_frame_;  // null: the generic head
  PatternPacketReader patterns_;
  std::int32_t slots_ = 0;               // that patterns fill
  std::optional<MotionDecoder> motion_;  // from the first pattern on
  std::optional<BlendDecoder> blend_;    // the same, where several patterns are blended
  std::optional<SoundSetup> sound_;
  Timeline pictures_;
};

}  // namespace fbs
