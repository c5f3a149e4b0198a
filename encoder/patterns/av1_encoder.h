// libaom, set up for coding patterns.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// libaom's --cpu-used, 0 (slow and small) to 6, for patterns that are sent. Against 4, 3 takes 1.6 times as
/// long for 3 % fewer bytes, 2 four times for 6 %, 1 seven times for 7 %; 5 takes 0.6 of the time for 6 %
/// more.
inline constexpr int kSentSpeed = 3;
/// Speed for trials.
inline constexpr int kTrialSpeed = 6;

inline constexpr int kMaxQuantiser = 63;  ///< the coarsest of libaom's scale

struct Av1Settings {
  int quantiser = 40;  ///< libaom's scale, 0..63
  int speed = kSentSpeed;
  /// Pictures that libaom may hold back to code a later one first; 0: each is coded at once, all at
  /// `quantiser`.
  int look_ahead = 0;
  /// With look-ahead, how many steps below `quantiser` frames that others refer to may go; 0..63.
  int boost = 0;
  /// With look-ahead, threads that code the rows of a frame. The frames are the same for any number from 2
  /// on; 1 codes them .3 to .8 % smaller (BD-rate, ten clips), since rows then adapt to all those before.
  int threads = 2;
};

/// One AV1 sequence, in which only the first frame is a key frame.
class Av1Encoder {
 public:
  using Frames = std::vector<std::vector<std::uint8_t>>;  ///< as from coded_frames()

  /// @param format  its size, range and matrix are written into the sequence header
  static Result<Av1Encoder> create(const VideoFormat& format, const Av1Settings& settings);

  /// @param picture  of the format's size; copied
  /// @param alone    nothing later refers to it, unless it is the first. If all are, each needs the first
  /// alone
  /// @return the frames coded since the last call, in coding order; without look-ahead exactly one
  Result<Frames> encode(const Picture& picture, bool alone = false);

  /// Changes settings for the pictures that follow, without look-ahead.
  /// @param quantiser  libaom's scale, 0..63
  /// @param speed      Av1Settings::speed. libaom 3.6 cannot go back from its real-time usage, which would be
  /// faster: it then writes frames that no decoder reads
  Result<void> set(int quantiser, int speed);

  /// The remaining frames; no picture may follow.
  Result<Frames> finish();

 private:
  struct Context;
  struct Deleter {
    void operator()(Context* c) const;
  };
  explicit Av1Encoder(std::unique_ptr<Context, Deleter> context) : context_(std::move(context)) {}
  std::unique_ptr<Context, Deleter> context_;
};

}  // namespace fbs
