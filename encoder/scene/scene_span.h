// The scenes that a video goes to and fro between: which is shown, and their packets in the order of
// pictures.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "bitstream/packet.h"
#include "encoder/scene/background.h"
#include "encoder/scene/scene_encoder.h"
#include "encoder/segment/segment.h"

namespace fbs {

/// Where a face gives way to another, its scene is left open, if it can go on, so that it need not be sent
/// again when it returns. As nothing of an open scene can be written yet, all end after some minutes: a span.
class SceneSpan {
 public:
  /// @param most  pictures of a span, after its second scene has begun
  /// @param together  scenes that may end at the same time, at least 1; the stream is the same
  SceneSpan(std::uint64_t most, std::size_t together) : most_(most), together_(together) {}

  /// Null before the first.
  [[nodiscard]] SceneEncoder* present() const {
    return present_ == nullptr ? nullptr : present_->scene.get();
  }

  /// Another scene is shown from this picture of the stream on; the present one is left.
  Result<void> begin(std::unique_ptr<SceneEncoder> scene, std::uint64_t picture);
  /// Goes on with an open scene that recognises the picture, if there is one. It begins another shot.
  /// @param at  its position
  [[nodiscard]] Result<bool> return_to(const Picture& picture, const StreamPosition& at);
  /// Ends the span before this picture if it is long enough.
  Result<void> end_span(std::uint64_t picture);
  /// Codes everything still held back.
  Result<void> finish();

  /// Whole packets that are ready, in stream order; forgets them.
  [[nodiscard]] std::vector<std::uint8_t> take();
  /// Whether packets may become ready without another call.
  [[nodiscard]] bool is_coding() const;
  /// Rings whenever that may have changed, or packets may have become ready.
  [[nodiscard]] const Bell& bell() const { return *bell_; }

 private:
  struct Member {
    std::unique_ptr<SceneEncoder> scene;  ///< null once it has ended, and another is shown
    std::uint64_t begin;                  ///< picture of the stream
    bool ends = false;                    ///< nothing more is shown of it
    PacketReader packets{};               ///< that it has coded
    std::optional<TypedPayload> next{};   ///< the first that is not written
    bool in_head = false;                 ///< its setup packet is written, and not its first pattern packet
    std::uint32_t check = 0;              ///< of the latter
  };
  /// From a picture of the stream on, a scene is shown.
  struct Visit {
    Member* shown;
    std::uint64_t begin;
    Member* left;  ///< the scene before, if it may return
  };

  /// Leaves the present scene before this picture.
  /// @return it if it may return, or null
  [[nodiscard]] Result<Member*> leave(std::uint64_t picture);
  /// Begins to end a scene.
  Result<void> end(Member& member);
  /// Waits until at most so many scenes are ending, and frees those that have ended.
  Result<void> wait(std::size_t ending);
  /// Begins to end all open scenes.
  Result<void> close();
  /// Whether all packets of a scene are ready.
  [[nodiscard]] static bool has_ended(const Member& member);
  /// Whether a scene returns behind the first of the visits, or may do so.
  [[nodiscard]] bool returns(const Member* member) const;
  static bool read_next(Member& member);
  /// Writes the next packet of the scene of the first visit.
  void write_next(std::vector<std::uint8_t>& out);

  std::uint64_t most_;
  std::size_t together_;
  std::shared_ptr<Bell> bell_ = std::make_shared<Bell>();
  std::vector<std::unique_ptr<Member>> members_;
  Member* present_ = nullptr;
  std::deque<Member*> open_;              ///< besides the present one, in the order in which they were left
  std::deque<Member*> ending_;            ///< their scenes are not freed yet
  std::uint64_t begin_ = 0;               ///< of the span: where a scene was first left open
  std::optional<std::uint64_t> ended_{};  ///< before this picture a span ended, and the present scene
  std::deque<Visit> visits_;              ///< whose packets are not all written
  PacketWriter writer_;
};

}  // namespace fbs
