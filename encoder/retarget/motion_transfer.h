// The motion of one face on another: what one does, measured by the size of its own features. Paper section
// 3, Fig. 7.
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

/// Maps states of the face that moves to states of the face that is shown.
///
/// Pose is what differs from the first picture: angles as they are, translation in eye distances, less that
/// of the background. Offsets of control points are scaled: the mouth's by the widths of the mouths and the
/// heights from mouth to chin, brows' and eyes' by their own widths and heights, so that shut eyes are shut.
/// Lips are as far apart as the others are, and touch where these do, however that is seen. Light and the
/// inside of the mouth stay those of the face that is shown.
class MotionTransfer {
 public:
  MotionTransfer(const MotionRecord& motion, const FaceStream& face);

  [[nodiscard]] StateNumbers operator()(const MotionRecord::Entry& picture) const;

 private:
  [[nodiscard]] Offsets scaled(const State& state, std::size_t geometry) const;
  /// Moves the lips so that they are as far apart as those of the picture.
  void match_gaps(const MotionRecord::Entry& picture, Offsets& offsets) const;

  const MotionRecord& motion_;
  const FaceStream& face_;
  std::vector<std::array<glm::dvec2, kFeatureCount>> scales_;  ///< of offsets, by geometry of the motion
  std::vector<double> lip_scales_;                             ///< of gaps, by geometry of the motion
  double shut_;   ///< mean gap up to which the motion's mouth is shut
  double ratio_;  ///< of the eye distances in the first pictures
};

}  // namespace fbs
