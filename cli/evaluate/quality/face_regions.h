// The face's region in each picture, the same for all streams of a source that are compared.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/files/stop_signal.h"
#include "cli/source/face_outline.h"
#include "common/result.h"
#include "decoder/stream/stream_decoder.h"

namespace fbs::cli {

struct FaceRegions {
  std::string origin;                 ///< "the mesh of quality 80", "faces.csv"
  std::vector<FaceOutline> outlines;  ///< of each picture; empty where no face is believed

  /// Pictures in which a face is believed.
  [[nodiscard]] std::size_t believed() const;
  /// The outline in a picture; none after the last.
  [[nodiscard]] const FaceOutline& of(std::size_t picture) const;
  /// Changes whenever an outline does.
  [[nodiscard]] std::size_t hash() const;
};

/// What a stream tells without drawing its pictures.
struct StreamTrack {
  ByteCount bytes;
  VideoFormat format;
  double seconds = 0;
  std::vector<double> times;          ///< of each picture, s
  std::vector<FaceOutline> outlines;  ///< of each picture
};

/// @return errors of StreamFile; kIo when the signal came
Result<StreamTrack> read_track(const std::string& stream, const StopSignal* stop);

/// Reads face regions from 68 landmarks per picture: the convex hull of the points, from the brows to the
/// chin.
///
/// A header line, then a line per picture. Columns, in any order: x0 ... x67 and y0 ... y67, or OpenFace's
/// x_0 ..., in pixels; `frame`, from 0 or 1, else the lines are the pictures in order; `success` and
/// `confidence`: a face is believed unless `success` is 0 or `confidence` below 0.5. Points that are not
/// numbers, such as `nan`, are left out; a face has at least 30. The first face of a picture counts.
///
/// @return kIo, kInvalidArgument with the faulty line; texts name the file
Result<FaceRegions> read_region_csv(const std::string& file);

/// The mesh of a stream, or read_region_csv() for anything else.
Result<FaceRegions> read_region(const std::string& file, const StopSignal* stop);

}  // namespace fbs::cli
