// Cuts: pictures that begin another shot.
#pragma once

#include <opencv2/core.hpp>

#include "common/picture.h"

namespace fbs {

/// Compares each picture with the one before it, at a long side of 64 pixels: blocks of one are matched in
/// the other without their means, so that neither motion nor a change of light is a cut. A cut is where
/// neither picture can be made of the other: what is merely uncovered or covered is missing in one of them
/// only. A sudden change from or to a plain picture, such as black, is a cut, too. Fades and dissolves are
/// not cuts.
class CutDetector {
 public:
  /// Luma at that size.
  [[nodiscard]] static cv::Mat1f thumbnail(const Picture& picture);

  /// Takes the next picture; all have one size.
  /// @return whether it begins another shot; false for the first one
  [[nodiscard]] bool is_cut(const Picture& picture);

  /// The thumbnail of that picture; empty ahead of the first.
  [[nodiscard]] const cv::Mat1f& last() const { return last_; }

  /// Share of a picture's contrast that another one's blocks cannot explain, 0..1.
  /// @param of, by  of one size
  /// @param reach   how far blocks may have moved, samples
  [[nodiscard]] static double unexplained(const cv::Mat1f& of, const cv::Mat1f& by, int reach);

 private:
  cv::Mat1f last_;
};

}  // namespace fbs
