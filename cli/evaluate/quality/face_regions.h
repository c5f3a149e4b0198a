// Where the face is in each picture: one region for all streams of a source that are compared.
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
  /// That of a picture; none behind the last.
  [[nodiscard]] const FaceOutline& of(std::size_t picture) const;
  /// Changes when an outline does.
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

/// Face regions from 68 landmarks a picture: the convex hull of the points, from the brows to the chin.
///
/// A header line, then a line a picture. Columns, in any order: x0 ... x67 and y0 ... y67, or x_0 ... as
/// OpenFace has them, in pixels; `frame`, from 0 or 1, else the lines are the pictures in their order;
/// `success` and `confidence`: a face is believed unless they are 0 and below 0.5. Points that are no number,
/// such as `nan`, are left out; a face has 30 at least. The first face of a picture counts.
///
/// @return kIo, kInvalidArgument with the line that is wrong; texts name the file
Result<FaceRegions> read_region_csv(const std::string& file);

/// The mesh of a stream, or read_region_csv() of anything else.
Result<FaceRegions> read_region(const std::string& file, const StopSignal* stop);

}  // namespace fbs::cli
