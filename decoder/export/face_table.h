// Pose, landmarks, gaze and expression of each picture as text: CSV, or JSON with the same numbers.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/picture.h"
#include "decoder/expression/expression_targets.h"

namespace fbs {

/// The numbers of a face. Angles and axes as in HeadPose (SPEC 8.1): x right, y down, z away from the viewer.
struct FaceNumbers {
  std::array<double, 3> rotation_deg{};  ///< pitch, yaw, roll
  glm::dvec2 translation_px{};           ///< of the head's origin, from the picture's upper left corner
  double scale = 0;                      ///< pixels per eye distance
  std::array<glm::dvec2, kLandmarkCount> landmarks{};  ///< pixels
  glm::dvec2 gaze_deg{};            ///< in the head's frame: positive to the picture's right, and down
  std::vector<double> blendshapes;  ///< weights of blendshape_names()
};

/// Computes the numbers of states; caches what depends on the head alone.
class FaceMeasure {
 public:
  [[nodiscard]] FaceNumbers operator()(const Geometry& head, const State& state);

 private:
  BlendshapeMeasure blendshapes_;
};

struct FaceRow {
  std::uint64_t frame = 0;          ///< from 0
  double seconds = 0;               ///< from the first picture
  double confidence = 0;            ///< 0..1
  bool success = false;             ///< whether the face is seen rather than guessed
  std::optional<FaceNumbers> face;  ///< none: the picture has no face
};

enum class TableFormat : std::uint8_t { kCsv, kJson };

/// Writes a table piece by piece: begin, rows, end.
class FaceTable {
 public:
  explicit FaceTable(TableFormat format) : format_(format) {}

  /// The header line, or the text before the list of frames.
  [[nodiscard]] std::string begin(const VideoFormat& video) const;
  [[nodiscard]] std::string row(const FaceRow& row);
  [[nodiscard]] std::string end() const;

 private:
  TableFormat format_;
  bool first_ = true;
};

}  // namespace fbs
