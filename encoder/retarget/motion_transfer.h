// Transfers the motion of one face to another, scaled by the sizes of their features. Paper section 3, Fig.
// 7.
#pragma once

#include <array>
#include <vector>

#include "bitstream/coded_state.h"
#include "encoder/model/expression_basis.h"
#include "encoder/retarget/face_stream.h"
#include "encoder/retarget/motion_record.h"

namespace fbs {

/// The numbers of a state in stream order, in the units of State, coefficients in head units; not rounded.
using StateNumbers = std::array<double, kParameterCount>;

[[nodiscard]] StateNumbers numbers_of(const State& state);

/// Maps states of the moving face to states of the shown face.
///
/// Pose is the change from the first picture: angles unchanged, translation in eye distances, less the
/// background's. Offsets of control points are scaled: the mouth's by the ratio of the mouths' widths and of
/// the heights from mouth to chin, brows' and eyes' by their own widths and heights, so that shut eyes stay
/// shut. Lips are as far apart as the moving face's, and touch where those do, even if measured apart. Light
/// and the inside of the mouth stay the shown face's.
class MotionTransfer {
 public:
  MotionTransfer(const MotionRecord& motion, const FaceStream& face);

  [[nodiscard]] StateNumbers operator()(const MotionRecord::Entry& picture) const;

 private:
  [[nodiscard]] Offsets scaled(const State& state, std::size_t geometry) const;
  /// Moves the lips as far apart as in the picture.
  void match_gaps(const MotionRecord::Entry& picture, Offsets& offsets) const;

  const MotionRecord& motion_;
  const FaceStream& face_;
  std::vector<std::array<glm::dvec2, kFeatureCount>> scales_;  ///< of offsets, by geometry of the motion
  std::vector<double> lip_scales_;                             ///< of gaps, by geometry of the motion
  double shut_;   ///< mean gap up to which the motion's mouth is shut
  double ratio_;  ///< of the eye distances in the first pictures
};

}  // namespace fbs
