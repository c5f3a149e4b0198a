// Learns the table of the landmark search: stage by stage, each from the results of those before it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "encoder/landmarks/landmark_table.h"
#include "training/augmentation.h"

namespace fbs {

/// Stages and mean shape; belief stays empty.
/// @param samples  with places that err as much as detectors do: each is used once, from the usual shape
[[nodiscard]] LandmarkTable train_cascade(const std::vector<PatchSample>& samples);

/// A linear map in the table's form.
[[nodiscard]] DescriptorMap quantised(const Eigen::MatrixXf& weights);

}  // namespace fbs
