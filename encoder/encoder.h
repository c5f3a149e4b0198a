// Pictures to stream: create, feed, take, finish.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/picture.h"
#include "common/result.h"
#include "encoder/analysis/picture_analysis.h"
#include "encoder/plan/group_clock.h"
#include "encoder/settings.h"

namespace fbs {

/// Statistics of the video so far.
struct EncodingReport {
  std::uint64_t pictures = 0;
  std::uint64_t without_face = 0;  ///< of those, pictures in which no face was tracked
  /// Pictures whose EncoderSettings::landmarks could be a start of the fit, and those where they were best.
  std::uint64_t with_landmarks = 0, from_landmarks = 0;
  std::uint64_t cuts = 0;
  std::uint64_t scenes = 0;  ///< begun for a person or a shot; key intervals divide them further
};

/// Encodes one video.
///
///   auto encoder = Encoder::create(format, settings);
///   for (each picture) { encoder->push(picture, duration); write(encoder->take()); }
///   encoder->finish(); write(encoder->take());
class Encoder {
 public:
  /// @return kInvalidArgument for settings or a format out of range
  static Result<Encoder> create(const VideoFormat& format, const EncoderSettings& settings);
  Encoder(Encoder&&) noexcept;
  Encoder& operator=(Encoder&&) noexcept;
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder();

  /// @param picture  4:2:0, of the format's size
  /// @param when     with a time to begin, which rises, a duration that is expected: GroupClock
  /// @return kInvalidArgument for another picture or duration, or after finish(): nothing has changed then;
  ///         kTooFewFaces when the first picture with a face shows fewer than EncoderSettings::face asks for
  Result<void> push(const Picture& picture, const PictureTime& when = {});

  /// Requests a place where a viewer can join: the present group becomes the last of its scene. Has no effect
  /// where a scene begins anyway.
  /// @return kInvalidArgument if the encoding is not live, or has ended
  Result<void> request_scene();

  /// A viewer has lost a pattern of the present scene for good: later ones are coded so that they need its
  /// head alone, as with Resilience::kStrong. Cheaper than another scene.
  /// @return kInvalidArgument if the encoding is not live, or has ended
  Result<void> lose_patterns();

  /// The link has another rate: holds what follows to it.
  /// @param kbps  > 0
  /// @return kInvalidArgument if the encoding is not live with a bitrate, or has ended
  Result<void> set_bitrate(double kbps);

  /// Codes everything still held back and ends the stream.
  /// @return kNoFace when no picture showed a face, whose text says if one lies on its side; kInvalidArgument
  ///         when there was no picture at all, or the stream has ended already
  Result<void> finish();

  /// The bytes that are ready; the encoder forgets them.
  [[nodiscard]] std::vector<std::uint8_t> take();

  /// Whether another thread is still coding: bytes become ready without another push.
  [[nodiscard]] bool is_coding() const;

  /// Waits until take() has bytes, or until no other thread is coding.
  /// @return whether take() has bytes
  [[nodiscard]] bool wait(std::chrono::steady_clock::time_point until);

  /// Degrees clockwise by which pictures must be turned for a face that lies in them: 90, 180, 270; 0: none
  /// does, as far as is known. Looked for in two pictures of the first two seconds, where no upright face is
  /// beyond doubt, and never live.
  [[nodiscard]] int turn_to_upright() const;

  [[nodiscard]] const PictureAnalysis& analysis() const;  ///< of the picture pushed last
  [[nodiscard]] const EncodingReport& report() const;

 private:
  struct Impl;
  explicit Encoder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Whether a stream misses EncoderSettings::bitrate by a tenth or more. A live one may exceed it by what
/// waits in its buffer and is sent later.
/// @param kbps  of the whole stream, which lasts so many seconds
[[nodiscard]] bool misses_bitrate(const EncoderSettings& settings, double kbps, double seconds);

}  // namespace fbs
