// Input of the figures: a sequence of pictures, its truth, and the codec's results.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bitstream/syntax.h"
#include "common/picture.h"
#include "common/result.h"
#include "decoder/scene/scene.h"
#include "encoder/encoder.h"
#include "encoder/model/pose.h"
#include "tests/figures/face_motion.h"
#include "tests/figures/wire_frame.h"

namespace fbs::figures {

struct Footage {
  std::string name;  ///< prefix of the file names of its figures
  VideoFormat format;
  std::vector<Picture> pictures;
  std::vector<Landmarks> truth;  ///< of each picture; empty when unknown
};

/// A talking head from tests/talker, close enough to fill the picture.
/// @param name  also the name of its figures
/// @param seed  of person and motion
[[nodiscard]] Footage talker_footage(const std::string& name, std::uint32_t seed);

/// The first pictures of a video file.
/// @return kDegenerateInput when it has fewer than a figure shows; what open_video_source returns
[[nodiscard]] Result<Footage> clip_footage(const std::string& path);

/// The encoder's and the decoder's view of a footage.
struct Followed {
  std::vector<PictureAnalysis> analysis;  ///< of each picture
  std::vector<std::uint8_t> stream;
  std::vector<State> states;  ///< of each picture, as decoded
  Scene scene;                ///< of the last picture

  [[nodiscard]] const Geometry& geometry() const { return scene.geometry->geometry(); }
  [[nodiscard]] Pose pose(std::size_t picture) const { return pose_of(states[picture]); }
  /// The head in any state, pixels.
  [[nodiscard]] std::vector<glm::dvec3> head(const State& state) const {
    return screen_vertices(scene.geometry->project_vertices(state), state);
  }
};

/// The paper's own path: one pattern, contours that move the mesh, and no fit.
[[nodiscard]] EncoderSettings paper_settings();

/// @return kNoFace when the first picture shows none: the wire-frame cannot be adapted
[[nodiscard]] Result<Followed> follow(const Footage& footage, const EncoderSettings& settings);

/// Decodes these pictures of a stream, in ascending order of number, each once.
[[nodiscard]] Result<std::vector<Picture>> decode(const std::vector<std::uint8_t>& stream,
                                                  const std::vector<int>& numbers);

/// The curve of a feature that has a snake, as tracked, pixels.
[[nodiscard]] const std::vector<glm::dvec2>& snake_of(const PictureAnalysis& analysis, FeatureId id);

/// The truth where it is known; otherwise as tracked, nan where the tracker's confidence was low.
[[nodiscard]] std::vector<double> measure(const Footage& footage, const Followed& followed,
                                          double FaceMotion::*what);

}  // namespace fbs::figures
