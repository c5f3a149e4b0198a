// The decoder as the player in a browser drives it: keeps all bytes that have come, goes to any time, draws
// an edited face.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bitstream/packet.h"
#include "common/picture.h"
#include "common/result.h"
#include "decoder/expression/expression_targets.h"
#include "decoder/expression/state_edit.h"
#include "decoder/stream/stream_decoder.h"
#include "fbs/fbs.h"
#include "web/module/web_sound.h"

namespace fbs::web {

/// Most pixels of a picture, 4096 x 2304. A module has 2 GB, and a scene of 64 patterns takes 220 bytes a
/// pixel.
inline constexpr std::uint64_t kMaxPixels = 4096 * 2304;

class WebDecoder {
 public:
  WebDecoder();

  /// Where the next bytes of the stream are to be written, before feed().
  [[nodiscard]] std::span<std::uint8_t> room(std::size_t size);
  /// Takes what was written into room().
  void feed();
  /// No more bytes will come.
  void finish();

  /// Goes on to the next picture, as StreamDecoder::next() does.
  [[nodiscard]] Result<DecodeStatus> next() { return decoder_->next(); }
  /// Goes to the scene in which a picture of a time lies, for next(); sound goes on from the time itself.
  /// @param time  1/90000 s
  /// @return false as long as no scene has come, and nothing has changed
  [[nodiscard]] bool seek(std::uint64_t time);

  /// Draws the picture that next() announced last, with the edit.
  [[nodiscard]] Result<const Picture*> draw();

  /// What the viewer adds to the motion of the stream.
  void edit(const StateEdit& edit) { edit_ = edit; }

  /// Of the picture that next() announced last.
  [[nodiscard]] const StreamDecoder& stream() const { return *decoder_; }
  /// With the edit; null without a face.
  struct Face {
    fbs_face_state state;
    std::array<fbs_landmark, FBS_LANDMARKS> landmarks;
    std::vector<double> blendshapes;
  };
  [[nodiscard]] const Face* face();

  [[nodiscard]] WebSound& sound() { return sound_; }
  /// Bytes that have come, and those of them that are sound.
  [[nodiscard]] std::uint64_t bytes() const { return stream_.size(); }
  [[nodiscard]] std::uint64_t sound_bytes() const { return sound_bytes_; }

 private:
  [[nodiscard]] State edited(const SceneGeometry& face) const;
  void count_sound(std::span<const std::uint8_t> bytes);

  std::vector<std::uint8_t> stream_;  ///< all that has come
  std::size_t fed_ = 0;               ///< of it
  bool finished_ = false;
  std::unique_ptr<StreamDecoder> decoder_;
  PacketReader packets_;  ///< for sound_bytes_
  std::uint64_t sound_bytes_ = 0;
  WebSound sound_;
  StateEdit edit_;
  Picture picture_;
  BlendshapeMeasure measure_;
  Face face_{};
};

}  // namespace fbs::web
