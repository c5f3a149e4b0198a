// Pictures to stream: create, feed, take, finish.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/picture.h"
#include "common/result.h"
#include "encoder/find/marks.h"

namespace fbs {

struct EncoderSettings {
  int quality = 50;            ///< 0..100; moves the pattern's quantiser, the steps and lambda together
  double bitrate = 0;          ///< kbit/s in all, quality then follows; 0: as quality says
  double seconds = 0;          ///< length of the video, for bitrate; 0: not known, ten are taken
  double motion_bitrate = 0;   ///< kbit/s of the motion alone; 0: as quality says
  int face = 0;                ///< which face to follow, the largest being 0
  std::optional<Marks> marks;  ///< by hand, for the first picture; automatic otherwise
  bool allow_no_face = false;  ///< code a video without any face as one still pattern instead of failing
  bool snakes = true;          ///< follow mouth and brows; off only to see what they are worth
  bool refine = true;          ///< fit the state to the picture; off only to see what it is worth
  bool surround = true;        ///< let hair, body and ground move; off only to see what it is worth
  int group_pictures = 0;      ///< pictures in a motion packet, 1..256; 0: one second's
};

/// The curve of one tracked feature.
struct SnakeOutline {
  std::vector<glm::dvec2> points;
  bool closed = false;  ///< the last point is joined to the first
  int iterations = 0;   ///< that the last picture needed
};

/// What the analysis saw in the picture pushed last; for overlays. Positions in pixels of the picture.
struct PictureAnalysis {
  bool face = false;
  double confidence = 0;                            ///< 0..1
  std::array<glm::dvec2, kVertexCount> vertices{};  ///< as fitted
  std::vector<SnakeOutline> snakes;                 ///< as tracked
};

/// Encodes one video.
///
///   auto encoder = Encoder::create(format, settings);
///   for (each picture) { encoder->push(picture, duration); write(encoder->take()); }
///   encoder->finish(); write(encoder->take());
class Encoder {
 public:
  /// @return kInvalidArgument for settings or a format out of range; kIo without OpenCV's cascades
  static Result<Encoder> create(const VideoFormat& format, const EncoderSettings& settings);
  Encoder(Encoder&&) noexcept;
  Encoder& operator=(Encoder&&) noexcept;
  ~Encoder();

  /// @param picture   of the format's size
  /// @param duration  1/90000 s; 0: as the frame rate says
  Result<void> push(const Picture& picture, std::uint32_t duration = 0);

  /// Codes what is still held back and ends the stream.
  /// @return kNoFace when no picture showed a face; kInvalidArgument when there was no picture at all
  Result<void> finish();

  /// The bytes that are ready; the encoder forgets them.
  [[nodiscard]] std::vector<std::uint8_t> take();

  [[nodiscard]] const PictureAnalysis& analysis() const;

 private:
  struct Impl;
  explicit Encoder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fbs
