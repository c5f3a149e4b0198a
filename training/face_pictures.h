// Faces with known landmarks, from which landmarks are learned.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "encoder/landmarks/shape.h"

namespace fbs {

struct FacePicture {
  std::string name;    ///< of its file
  std::string person;  ///< training and testing never share a person
  cv::Mat1b luma;
  Shape landmarks;  ///< pixels; the first pixel's centre is (0.5, 0.5)
};

/// The stills of `folder`: faces.csv names them, with 68 landmarks each.
/// @param persons  lines "file person" for people who have several files; '#' begins a comment
[[nodiscard]] std::vector<FacePicture> load_stills(const std::filesystem::path& folder,
                                                   const std::filesystem::path& persons);

/// Pictures of each clip in `folder`, evenly spaced, with the landmarks of `reference`/CLIP.csv.
/// @param persons  as of load_stills(); clips have no extension there
[[nodiscard]] std::vector<FacePicture> load_clips(const std::filesystem::path& folder,
                                                  const std::filesystem::path& reference,
                                                  const std::filesystem::path& persons, int per_clip);

/// Generated talkers.
[[nodiscard]] std::vector<FacePicture> load_talkers(int count);

}  // namespace fbs
