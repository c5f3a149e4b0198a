// The sound of a stream in time: what is lost is filled, what comes twice is left out.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bitstream/sound_syntax.h"
#include "bitstream/sound_time.h"
#include "common/result.h"
#include "decoder/sound/sound_decoder.h"

namespace fbs {

/// Of a gap so much is concealed by the codec, the rest is silence; 1/kSoundClock s.
inline constexpr std::int32_t kConcealedSound = kSoundClock / 10;

/// Samples that follow one another.
struct SoundPiece {
  std::int64_t time = 0;  ///< of the first sample, 1/kSoundClock s after the first picture; not negative
  int sample_rate = 0;    ///< 48000 or 8000
  int channels = 0;       ///< 1 or 2
  std::vector<std::int16_t> samples;  ///< interleaved
};

/// Takes setups and groups in the order of the stream, one at a time, and gives samples in pieces of at most
/// a frame. Each piece begins where the one before ended, but for the first, for the first after reset(), and
/// for rounding to a sample where another setup takes over. Holds one group and no more than one frame's
/// samples.
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
  /// The codec of the groups that follow; all groups before have been read. The same again changes nothing.
  /// @return errors of SoundDecoder::create; groups before the next valid setup are then refused
  Result<void> set(const SoundSetup& setup);

  /// The groups before have been read. Frames with numbers below the last one's are left out.
  /// @return kInvalidStream when there is no setup, or the numbers are out of 0..kMaxSoundFrames - 1
  Result<void> add(SoundGroup group);

  /// The next samples: of a frame, or of a gap before it. Frames that are all before the first picture give
  /// nothing. A gap is as long as the stream says, hours if need be: stop at the end of the pictures.
  /// @param piece  overwritten; its memory is used again
  /// @return false when another group is needed; kInvalidStream when a frame is wrong: it is concealed by the
  /// next call
  Result<bool> next(SoundPiece& piece);

  /// After a seek: the next group may be from anywhere, and no gap is seen before it.
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
  std::int64_t next_frame_ = 0;  // below this frames of this setup have been decoded or concealed
  std::int64_t given_ = 0;       // time of the end of what has been given
  bool begun_ = false;           // something has been given: what lacks from here on is a gap
  bool decoded_ = false;         // the decoder has something to continue
  std::int64_t concealed_ = 0;   // since the last frame, 1/kSoundClock s
};

}  // namespace fbs
