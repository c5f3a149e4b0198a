// Motion of body and ground since the first picture: the parts of the surround that move by similarities.
#pragma once

#include <vector>

#include "bitstream/syntax.h"
#include "common/picture.h"
#include "encoder/model/picture_cost.h"
#include "encoder/surround/keypoint.h"
#include "encoder/surround/similarity_alignment.h"
#include "encoder/surround/surround_cost.h"

namespace fbs {

/// Estimates the similarities of body and ground from the first picture to each later one, not from one to
/// the next, so that nothing drifts. Each is about the head's origin, as in State. Method: keypoints of the
/// first picture are aligned to the later picture (SimilarityAlignment). A keypoint's layer starts from a
/// spatial prior and is refined from the residuals that the layers' motions leave in picture after picture
/// (LayerMembership). Works at a long side of at most kMotionLongSide pixels, whatever the size of the
/// picture.
class SurroundMotion {
 public:
  /// @param first  the scene's first picture
  /// @param seen   its state
  SurroundMotion(const Picture& first, const State& seen);

  /// @param head  pose in this picture
  void observe(const Picture& picture, const Pose& head);

  /// From now on the map is the keypoints' prior and decides their motion.
  void set_map(const SurroundMap& map);

  /// Writes the estimate for the last picture into a state.
  void add_to(State& state) const;
  /// Adds the region kSurround: the cost of other similarities of body and ground in the last picture.
  void add_to(PictureCost& cost) const;

 private:
  /// A layer that moves by a similarity, or rests.
  struct Part {
    Similarity aligned{};   ///< accepted or not: the start of the next alignment
    Similarity accepted{};  ///< equal to `aligned`, or to rest
    bool moves = false;
  };
  /// Accepts the motion of a part if it explains the picture clearly better than rest.
  static void accept(const SimilarityAlignment& alignment, Layer layer, const Similarity& rest, bool rim_only,
                     Part& part);
  /// Aligns the body from where it was or, if that explains too little, from elsewhere.
  [[nodiscard]] Similarity align_body(const SimilarityAlignment& alignment, const Similarity& rest,
                                      glm::dvec2 head_displacement) const;
  void refine_layers(const Pose& head);

  int factor_;  ///< picture pixels per work pixel
  Pose seen_;
  int width_, height_;
  SurroundPyramid luma_;  ///< of the last picture
  std::vector<Keypoint> keypoints_;
  bool ground_shows_;  ///< enough of it near the rim to tell whether it moves
  Part body_, ground_;
  HeadDisplacement head_;
  bool mapped_ = false;
  int pictures_ = 0;
};

}  // namespace fbs
