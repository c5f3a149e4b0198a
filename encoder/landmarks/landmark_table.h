// The learned part of the landmark search: made by train_landmarks, built into the encoder.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/result.h"
#include "encoder/landmarks/descriptor.h"

namespace fbs {

/// Directions in which a stage moves a shape.
inline constexpr int kShapeModes = 24;

/// A linear map of descriptors. Weights have 8 bits, with a scale for each output.
struct DescriptorMap {
  int outputs = 0;
  std::vector<std::int8_t> weights;  ///< kDescriptorSize rows of `outputs`
  std::vector<float> scale;          ///< of each output
  /// @param descriptor  kDescriptorSize
  [[nodiscard]] std::vector<float> operator()(std::span<const float> descriptor) const;
};

/// One step of the cascade: shape += modes^T * regression(descriptor) + offset, in units of the mean shape.
struct LandmarkStage {
  Look look;
  DescriptorMap regression;   ///< kShapeModes outputs
  std::vector<float> modes;   ///< kShapeModes rows of x0, y0, x1, y1 ...
  std::vector<float> offset;  ///< x0, y0, x1, y1 ...
};

/// Scores the look of a face at its landmarks, at one resolution.
struct BeliefView {
  Look look;
  DescriptorMap score;  ///< one output
};
inline constexpr std::size_t kBeliefViews = 2;

/// Probability that landmarks are right and belong to a face: a logistic function of the views' scores +
/// spread * log(final disagreement of the starts + kLeastSpread) + place * (PlaceSearch's score of the place)
/// + offset.
struct BeliefTable {
  std::array<BeliefView, kBeliefViews> views;
  float spread = 0, place = 0, offset = 0;
};
inline constexpr float kLeastSpread = 0.001F;  ///< eye distances

/// How much a place looks like the mean face: score . descriptor + offset, 1 on faces and 0 elsewhere
/// (PlaceSearch).
struct PlaceTable {
  DescriptorMap score;  ///< one output
  float offset = 0;
};

struct LandmarkTable {
  Shape mean{};  ///< root-mean-square radius 1 about (0, 0)
  PlaceTable places;
  std::vector<LandmarkStage> stages;
  BeliefTable belief;
};

/// @return kUnsupported for another version, kInvalidStream for a table that is truncated or has other sizes
[[nodiscard]] Result<LandmarkTable> read_landmark_table(std::span<const std::uint8_t> bytes);

/// The inverse of read_landmark_table().
[[nodiscard]] std::vector<std::uint8_t> write_landmark_table(const LandmarkTable& table);

/// The built-in table. FBS_LANDMARKS, a path, replaces it: for the cross-validation.
/// @return kIo, or errors of read_landmark_table()
[[nodiscard]] Result<LandmarkTable> load_landmarks();

}  // namespace fbs
