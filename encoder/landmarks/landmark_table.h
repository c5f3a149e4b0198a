// What the search for landmarks has learned: train_landmarks makes the table, the encoder has it built in.
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

/// A linear map of descriptors. Weights are 8 bits and have a scale for each output.
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

/// What a face looks like at its landmarks, seen in one way.
struct BeliefView {
  Look look;
  DescriptorMap score;  ///< one output
};
inline constexpr std::size_t kBeliefViews = 2;

/// How probable it is that landmarks are those of a face and right: a logistic function of
/// the views' scores + spread * log(how far the starts differ in the end + kLeastSpread)
/// + place * (how much the place looked like a face, PlaceSearch) + offset.
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

/// @return kUnsupported for another version, kInvalidStream for a table that is cut off or has other sizes
[[nodiscard]] Result<LandmarkTable> read_landmark_table(std::span<const std::uint8_t> bytes);

/// What read_landmark_table() reads.
[[nodiscard]] std::vector<std::uint8_t> write_landmark_table(const LandmarkTable& table);

/// The one that is built in. FBS_LANDMARKS, a path, puts another in its place: for the cross-validation.
/// @return kIo, or errors of read_landmark_table()
[[nodiscard]] Result<LandmarkTable> load_landmarks();

}  // namespace fbs
