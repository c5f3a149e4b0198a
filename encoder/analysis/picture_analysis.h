// Results of the analysis of a picture: for overlays, tables and measurements.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <vector>

#include "bitstream/syntax.h"
#include "common/generic_head.h"
#include "common/state.h"

namespace fbs {

/// A snake as it came to rest.
struct SnakeOutline {
  std::vector<glm::dvec2> points;  ///< pixels of the picture, in order along the curve
  bool closed = false;
  int iterations = 0;  ///< of the last descent
};

/// Positions in pixels of the picture.
struct PictureAnalysis {
  bool face = false;            ///< whether the scene has one
  bool followed = false;        ///< whether it is followed in this picture; else it is held
  double confidence = 0;        ///< 0..1
  Geometry geometry;            ///< of the face
  State state;                  ///< as fitted, in whole units: finer than in a stream
  bool had_landmarks = false;   ///< whether EncoderSettings::landmarks were a start of its fit
  bool from_landmarks = false;  ///< and the best one
  std::array<glm::dvec2, kVertexCount> vertices{};  ///< as fitted
  std::vector<SnakeOutline> snakes;                 ///< as tracked
};

}  // namespace fbs
