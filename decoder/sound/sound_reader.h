// The sound of a stream on its time line: losses are filled, repeats left out.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bitstream/sound_syntax.h"
#include "bitstream/sound_time.h"
#include "common/result.h"
#include "decoder/sound/sound_decoder.h"

namespace fbs {

/// The codec conceals this much of a gap; the rest is silence; 1/kSoundClock s.
inline constexpr std::int32_t kConcealedSound = kSoundClock / 10;

/// Consecutive samples.
struct SoundPiece {
  std::int64_t time = 0;  ///< of the first sample, 1/kSoundClock s after the first picture; not negative
  int sample_rate = 0;    ///< 48000 or 8000
  int channels = 0;       ///< 1 or 2
  std::vector<std::int16_t> samples;  ///< interleaved
};

/// Takes setups and groups in the order of the stream, one at a time, and gives samples in pieces of at most
/// a frame. Each piece begins where the one before ended, except the first, the first after reset(), and for
/// rounding to a sample where another setup begins. Holds one group and at most one frame's samples.
///
///     reader.set(setup);
///     reader.add(group);
///     while (true) {
///       const auto more = reader.next(piece);
///       if (more && !*more) break;          // the next group
///       if (more) write(piece.samples);     // else: report; the frame will be concealed
///     }
class SoundReader {
 public:
  /// Sets the codec of the groups that follow; all groups before have been read. Setting the same again
  /// changes nothing.
  /// @return errors of SoundDecoder::create; groups before the next valid setup are then refused
  Result<void> set(const SoundSetup& setup);

  /// Adds a group when those before have been read. Frames with numbers below the last one's are left out.
  /// @return kInvalidStream when there is no setup, or the numbers are out of 0..kMaxSoundFrames - 1
  Result<void> add(SoundGroup group);

  /// The next samples: of a frame, or of a gap before it. Frames wholly before the first picture give
  /// nothing. A gap is as long as the stream says, hours if need be: stop at the end of the pictures.
  /// @param piece  overwritten; its memory is reused
  /// @return false when another group is needed; kInvalidStream when a frame is faulty: the next call
  /// conceals it
  Result<bool> next(SoundPiece& piece);

  /// After a seek: the next group may be from anywhere, and no gap is assumed before it.
  void reset();

 private:
  [[nodiscard]] std::int64_t frame_time() const { return fbs::frame_time(setup_, frame_); }
  [[nodiscard]] bool has_frame() const { return index_ < group_.frames.size(); }
  Result<bool> fill(std::int64_t end, SoundPiece& piece);
  Result<void> decode_frame(std::vector<std::int16_t>& out);
  Result<void> conceal(std::vector<std::int16_t>& out);
  bool give(std::int64_t time, std::int64_t end, SoundPiece& piece);

  SoundSetup setup_;
  std::unique_ptr<SoundDecoder> decoder_;  // null: no setup yet
  SoundGroup group_;
  std::size_t index_ = 0;        // of the next frame in the group
  std::int64_t frame_ = 0;       // its number
  std::int64_t next_frame_ = 0;  // frames of this setup below this have been decoded or concealed
  std::int64_t given_ = 0;       // end time of the samples given
  bool begun_ = false;           // something has been given: missing sound from here on is a gap
  bool decoded_ = false;         // the decoder has something to continue
  std::int64_t concealed_ = 0;   // since the last frame, 1/kSoundClock s
};

}  // namespace fbs
