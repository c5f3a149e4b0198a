// Finds the 68 landmarks of a face in a picture by a learned cascade of regressions.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "encoder/landmarks/descriptor.h"
#include "encoder/landmarks/face_patch.h"
#include "encoder/landmarks/landmark_table.h"

namespace fbs {

/// Landmarks found where a face was supposed.
struct FoundLandmarks {
  std::array<glm::dvec2, kLandmarkCount> points{};  ///< pixels; the first pixel's centre is (0.5, 0.5)
  /// Probability, 0..1, that there is a face and that lips and eyes are right to a fifth of the eye distance.
  double belief = 0;
};

/// Method: Xiong & De la Torre, Supervised Descent Method, 2013: in each stage the shape moves by a linear
/// function of the descriptors at its landmarks. Differs: another kind of descriptor, taken in the shape's
/// own frame; several starts, of which the median counts, and their agreement.
class LandmarkSearch {
 public:
  explicit LandmarkSearch(LandmarkTable table) : table_(std::move(table)) {}

  /// @param picture  luma, 8 bits
  /// @param place    known to about a tenth of the face's size
  [[nodiscard]] FoundLandmarks find(const cv::Mat& picture, const FacePlace& place) const;

  /// The same for a face found in an earlier picture.
  /// @param last  its landmarks then, or predicted for now; pixels
  [[nodiscard]] FoundLandmarks follow(const cv::Mat& picture, const Shape& last) const;

  /// The mean shape at the supposed place of the face in every patch.
  [[nodiscard]] static Shape usual_shape(const Shape& mean);

  /// `shape` after a stage.
  /// @param view  at the stage's resolution
  [[nodiscard]] static Shape moved(const LandmarkStage& stage, const Shape& mean, const UprightView& view,
                                   const Shape& shape);

  /// The result of several starts.
  struct Agreement {
    Shape shape{};     ///< median of the ends, in the patch
    float spread = 0;  ///< mean distance of the ends' landmarks from it, eye distances
  };
  /// Starts near the usual shape.
  [[nodiscard]] Agreement descend(const cv::Mat1b& patch) const;

  [[nodiscard]] const LandmarkTable& table() const { return table_; }

 private:
  /// Starts from shapes with the same rotation and size in the patch, so that one view serves all.
  [[nodiscard]] Agreement descend_together(const cv::Mat1b& patch, std::vector<Shape> shapes) const;
  [[nodiscard]] static Agreement agreement_of(const std::vector<Shape>& ends);
  [[nodiscard]] FoundLandmarks found(const FacePatch& patch, const Agreement& end) const;
  [[nodiscard]] double believe(const cv::Mat1b& patch, const Agreement& end) const;

  LandmarkTable table_;
};

}  // namespace fbs
