// Landmarks of a video's pictures, found by another program.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <string_view>

#include "common/generic_head.h"
#include "common/result.h"

namespace fbs {

/// The 68 landmarks of a face (iBUG order), pixels of the picture.
using LandmarkPoints = std::array<glm::dvec2, kLandmarkCount>;

/// By number of the picture, from 0. A picture without a face is absent.
using LandmarkTrack = std::map<std::uint64_t, LandmarkPoints>;

/// Reads a table of comma-separated values with a header line. Columns are found by name, blanks around names
/// and values are ignored, and so are other columns:
/// - x0,y0 .. x67,y67, with pictures counted from 0, or OpenFace's x_0 .. x_67, y_0 .. y_67, with pictures
///   counted from 1;
/// - frame, the number of the picture;
/// - success or found, confidence (either may be missing): a row with 0, or with a confidence below 0.5,
/// means
///   a picture without a face;
/// - face_id (may be missing): rows of other faces than 0 are ignored.
/// A row with an empty or `nan` point also means a picture without a face.
///
/// @param text          of the file
/// @param width, height of the pictures, pixels
/// @return kInvalidArgument, with the line's number: a column is missing, a row has another number of fields
/// than the header, a field is not a number, two rows have the same picture, no row has a face, or all faces
/// lie outside the picture or are as small as in coordinates of 0..1
[[nodiscard]] Result<LandmarkTrack> parse_landmarks(std::string_view text, int width, int height);

/// parse_landmarks() on a file.
/// @return also kIo; errors do not name the file
[[nodiscard]] Result<LandmarkTrack> read_landmarks(const std::string& path, int width, int height);

}  // namespace fbs
