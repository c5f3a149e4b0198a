// Learns the table of the search for landmarks: stage by stage, each from where the ones before it lead.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "encoder/landmarks/landmark_table.h"
#include "training/augmentation.h"

namespace fbs {

/// Stages and mean shape; belief stays empty.
/// @param samples  whose places are as far off as detectors are: each is learned from once, from the usual
///                 shape
[[nodiscard]] LandmarkTable train_cascade(const std::vector<PatchSample>& samples);

/// A linear map in the table's form.
[[nodiscard]] DescriptorMap quantised(const Eigen::MatrixXf& weights);

}  // namespace fbs
