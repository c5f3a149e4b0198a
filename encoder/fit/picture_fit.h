// Fits the state to what the viewer will see: pattern against picture, at points spread over the mesh. Design
// section 6.
#pragma once

#include <vector>

#include "decoder/head/head_deformation.h"
#include "decoder/head/mouth_interior.h"
#include "encoder/image/work_frame.h"
#include "encoder/model/fit.h"
#include "encoder/model/picture_cost.h"
#include "encoder/model/surface.h"

namespace fbs {

/// Compares the pattern, smeared on the moved mesh, with a picture. Works at the work frame's size, whatever
/// the size of the picture.
class PictureFit {
 public:
  /// @param pattern  work frame of the decoded pattern, cut like those of the later pictures
  /// @param seen     state of the pattern
  /// The control points of setup.parts may move.
  PictureFit(const Setup& setup, const Geometry& geometry, const WorkFrame& pattern, const State& seen);

  /// The picture that the next calls are about; its luma is shared.
  /// @param mouth  luma that the decoder shows inside the mouth, as far as is known
  void look_at(const WorkFrame& picture, const MouthInterior& mouth);

  /// `start` with the upper lids where the pattern, smeared on the closing eyes, looks most like the picture:
  /// where they are, wider, or shut by some fifths, both eyes alike unless the picture insists. A blink is
  /// over in three pictures, too fast to be followed downhill.
  [[nodiscard]] Fit with_best_lids(const Fit& start) const;

  /// Minimises the robust squared difference over pose and control points together: Gauss-Newton, coarse to
  /// fine, held near `start` where the picture says nothing and near rest everywhere.
  [[nodiscard]] Fit refine(const Fit& start) const;

  /// refine(), from `start` and, where the inner lips have strayed from where the outer ones take them, from
  /// there, too: a mouth that opens at once leaves their contour behind.
  [[nodiscard]] Fit refine_mouth(const Fit& start) const;

  /// How the picture changes round a fit.
  [[nodiscard]] PictureCost cost_at(const Fit& fit) const;

  /// The head's vertices in the head frame, head units.
  [[nodiscard]] HeadVertices deformed(const Fit& fit) const;

 private:
  static constexpr int kLevels = 2;
  static constexpr int kFirstInsideColumn = kPoseCount + kLightCount;
  static constexpr int kFirstControlColumn = kFirstInsideColumn + kInteriorCount;
  /// The points of one triangle, and how the control points that move it move each.
  struct Patch {
    std::size_t first, end;              ///< points
    std::vector<std::int16_t> controls;  ///< rising
    std::vector<float> shares;           ///< of each control point, point by point
  };
  [[nodiscard]] Patch patch_of(std::size_t first, std::size_t end) const;

  /// An upper lid: its control points and how far they go down to shut the eye, and the points that it moves.
  struct Lid {
    std::size_t first_control = 0;
    double travel = 0;  ///< head units
    std::vector<std::size_t> points;
  };

  [[nodiscard]] Lid lid_of(FeatureId id, int lower_landmark) const;
  /// Mean robust squared difference over what a lid moves.
  [[nodiscard]] double lid_difference(const Lid& lid, const Fit& fit) const;
  /// Normal equations; the upper triangle of `left` counts.
  struct Normal {
    explicit Normal(std::size_t unknowns) : n(unknowns), left(n * n), right(n) {}
    double& at(std::size_t row, std::size_t column) { return left[row * n + column]; }
    std::size_t n;
    std::vector<double> left, right;
    double cost = 0;  ///< robust squared differences, of all points
  };
  /// What is believed before looking: near the start, and an expression that faces make.
  void add_priors(const Fit& start, const Fit& fit, Normal& normal) const;
  /// What the picture says, at every point.
  void add_picture(int level, const Fit& fit, Normal& normal) const;
  /// One Gauss-Newton step on one level; false when it cannot be solved.
  bool step(int level, const Fit& start, Fit& fit) const;
  /// What the decoder shows at a point: the pattern, or the mouth's inside by as much as the lips have
  /// parted.
  [[nodiscard]] double shown(std::size_t point, int level, std::int32_t shade, const Fit& fit) const;
  /// What one unit of each light adds at a point.
  [[nodiscard]] std::array<double, kLightCount> light_at(std::size_t point, double pattern) const;
  /// Shares of the numbers of the mouth's inside at a place of the ramp from upper (0) to lower lip (1).
  [[nodiscard]] static std::array<double, kInteriorCount> inside_at(double ramp);
  /// Robust mean of squared differences on the fine level.
  [[nodiscard]] double difference(const Fit& fit) const;

  Geometry geometry_;
  std::vector<SurfacePoint> points_;
  std::vector<Patch> patches_;
  std::array<std::vector<float>, kLevels> pattern_luma_;  ///< at each point; negative outside
  std::vector<int> column_;  ///< of a control point's x in the normal equations, or -1
  int unknowns_ = kFirstControlColumn;
  std::vector<glm::dvec2> rest_;  ///< of each point: head frame, eye distances
  std::vector<int> points_on_triangle_;
  std::vector<float> mouth_ramp_;  ///< of each point, 0 upper to 1 lower lip; negative: not inside
  std::array<Lid, 2> lids_;
  std::int32_t gap_seen_ = 0;  ///< mouth_gap() of the pattern
  WorkFrame picture_;
  MouthInterior mouth_;
  std::array<cv::Mat, kLevels> luma_;
};

}  // namespace fbs
