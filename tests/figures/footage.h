// Input of the figures: a sequence of pictures, its truth, and the codec's results.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bitstream/syntax.h"
#include "common/picture.h"
#include "common/result.h"
#include "encoder/encoder.h"
#include "encoder/model/pose.h"
#include "tests/figures/face_motion.h"

namespace fbs::figures {

struct Footage {
  std::string name;  ///< prefix of the file names of its figures
  VideoFormat format;
  std::vector<Picture> pictures;
  std::vector<Landmarks> truth;  ///< of each picture; empty when unknown
};

/// A talking head of samples/, close enough to fill the picture.
[[nodiscard]] Footage talker_footage();

/// The first pictures of a video file.
/// @return kDegenerateInput when it has fewer than a figure shows; what open_video_source returns
[[nodiscard]] Result<Footage> clip_footage(const std::string& path);

/// The encoder's and the decoder's view of a footage, at default settings.
struct Followed {
  std::vector<PictureAnalysis> analysis;  ///< of each picture
  std::vector<std::uint8_t> stream;
  Geometry geometry;        ///< as decoded
  std::vector<Pose> poses;  ///< of each picture, as decoded
};

/// @return kNoFace when the first picture shows none: the wire-frame cannot be adapted
[[nodiscard]] Result<Followed> follow(const Footage& footage);

/// Decodes these pictures of a stream, in ascending order of number, each once.
[[nodiscard]] Result<std::vector<Picture>> decode(const std::vector<std::uint8_t>& stream,
                                                  const std::vector<int>& numbers);

/// The curve of a feature that has a snake, as tracked, pixels.
[[nodiscard]] const std::vector<glm::dvec2>& snake_of(const PictureAnalysis& analysis, FeatureId id);

/// The truth where it is known; otherwise as tracked, nan where the tracker's confidence was low.
[[nodiscard]] std::vector<double> measure(const Footage& footage, const Followed& followed,
                                          double FaceMotion::*what);

}  // namespace fbs::figures
