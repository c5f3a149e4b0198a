// Finds the 68 landmarks of a face in a picture by a cascade of regressions that were learned.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "encoder/landmarks/descriptor.h"
#include "encoder/landmarks/face_patch.h"
#include "encoder/landmarks/landmark_table.h"

namespace fbs {

/// Landmarks that were found where a face was thought to be.
struct FoundLandmarks {
  std::array<glm::dvec2, kLandmarkCount> points{};  ///< pixels; the first pixel's centre is (0.5, 0.5)
  /// Probability, 0..1, that there is a face and that lips and eyes are right to a fifth of the eye distance.
  double belief = 0;
};

/// Method: Xiong & De la Torre, Supervised Descent Method, 2013: in each stage the shape moves by a linear
/// function of what the picture looks like at its landmarks. Differs: descriptors of another kind, seen in
/// the shape's own frame; several starts, whose median is taken and whose agreement counts.
class LandmarkSearch {
 public:
  explicit LandmarkSearch(LandmarkTable table) : table_(std::move(table)) {}

  /// @param picture  luma, 8 bits
  /// @param place    known to about a tenth of the face's size
  [[nodiscard]] FoundLandmarks find(const cv::Mat& picture, const FacePlace& place) const;

  /// The same for a face that was found in a picture before.
  /// @param last  its landmarks then, or as they are thought to be now; pixels
  [[nodiscard]] FoundLandmarks follow(const cv::Mat& picture, const Shape& last) const;

  /// The mean shape where the face is thought to be in every patch.
  [[nodiscard]] static Shape usual_shape(const Shape& mean);

  /// `shape` after a stage.
  /// @param view  by the stage's look
  [[nodiscard]] static Shape moved(const LandmarkStage& stage, const Shape& mean, const UprightView& view,
                                   const Shape& shape);

  /// Where several starts lead.
  struct Agreement {
    Shape shape{};     ///< median of the ends, in the patch
    float spread = 0;  ///< mean distance of the ends' landmarks from it, eye distances
  };
  /// From about the usual shape.
  [[nodiscard]] Agreement descend(const cv::Mat1b& patch) const;

  [[nodiscard]] const LandmarkTable& table() const { return table_; }

 private:
  /// From shapes that lie alike in the patch, so that one view does for all of them.
  [[nodiscard]] Agreement descend_together(const cv::Mat1b& patch, std::vector<Shape> shapes) const;
  [[nodiscard]] static Agreement agreement_of(const std::vector<Shape>& ends);
  [[nodiscard]] FoundLandmarks found(const FacePatch& patch, const Agreement& end) const;
  [[nodiscard]] double believe(const cv::Mat1b& patch, const Agreement& end) const;

  LandmarkTable table_;
};

}  // namespace fbs
