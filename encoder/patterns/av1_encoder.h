// libaom as the coders of patterns use it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/picture.h"
#include "common/result.h"

namespace fbs {

/// libaom's --cpu-used, 0 (slow and small) to 9, for what is sent. Against 4, 3 takes 1.6 times as long for 3
/// % fewer bytes, 2 four times for 6 %, 1 seven times for 7 %; 5 takes 0.6 of the time for 6 % more.
inline constexpr int kSentSpeed = 3;
/// For what is only looked at.
inline constexpr int kTrialSpeed = 6;

struct Av1Settings {
  int quantiser = 40;  ///< libaom's scale, 0..63
  int speed = kSentSpeed;
  /// Pictures that libaom may hold back to code a later one first; 0: each is coded at once, all at
  /// `quantiser`.
  int look_ahead = 0;
  /// With look-ahead, how many steps below `quantiser` frames may go that others refer to; 0..63.
  int boost = 0;
};

/// One AV1 sequence of which only the first frame is a key frame.
class Av1Encoder {
 public:
  using Frames = std::vector<std::vector<std::uint8_t>>;  ///< as coded_frames gives them

  /// @param format  its size, range and matrix are written into the sequence header
  static Result<Av1Encoder> create(const VideoFormat& format, const Av1Settings& settings);

  /// @param picture  of the format's size; copied
  /// @return the frames that are coded since the last call, in coding order; without look-ahead exactly one
  Result<Frames> encode(const Picture& picture);

  /// For the pictures that follow, without look-ahead.
  /// @param quantiser  libaom's scale, 0..63
  /// @param speed      Av1Settings::speed
  Result<void> set(int quantiser, int speed);

  /// The rest; no picture may follow.
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
