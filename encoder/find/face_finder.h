// Finds the faces of a picture with their landmarks: searches landmarks at the likeliest places and keeps
// those with enough belief.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "common/picture.h"
#include "common/result.h"
#include "encoder/landmarks/landmark_search.h"
#include "encoder/landmarks/place_search.h"

namespace fbs {

/// A face with enough belief.
struct FoundFace {
  FoundLandmarks landmarks;
  FacePlace place;  ///< from the landmarks
};

class FaceFinder {
 public:
  /// Belief from which a face counts as one; higher for a face that is small in its picture, which has many
  /// places for one. The next pictures of a video are as good, so a false face is worse than a missed one: of
  /// 196 pictures without a face and 620 of text none passes.
  static constexpr double kBelieved = 0.5, kBelievedIfSmall = 0.8;

  /// Belief of a face beyond doubt. An upright face has 0.6 at most when it is turned.
  static constexpr double kClear = 0.9;

  enum class Effort : std::uint8_t { kUsualSizes, kAllSizes };

  /// Errors of load_landmarks().
  static Result<FaceFinder> create();

  /// Faces whose eyes are a 15th to half of the picture's shorter side apart. The largest first, by size
  /// times belief.
  /// @param wanted  number of faces wanted; a few more may be found
  /// @param effort  whether to look for faces half as large, too, when fewer are found: three times as slow
  [[nodiscard]] std::vector<FoundFace> find(const Picture& picture, std::size_t wanted = 1,
                                            Effort effort = Effort::kAllSizes) const;

  /// Finds faces of certain sizes, in the same order.
  [[nodiscard]] std::vector<FoundFace> find(const Picture& picture, const EyeDistances& sizes,
                                            std::size_t wanted) const;

  /// Quarter turns that put upright a face that lies on its side or stands on its head: 90, 180 or 270
  /// degrees clockwise; 0: no such face is beyond doubt. Of 1400 pictures that are upright, or have no face,
  /// none is. Takes three times as long as find() of usual sizes.
  /// @param threads  at least 1
  [[nodiscard]] int turn_to_upright(const Picture& picture, int threads) const;

  [[nodiscard]] const LandmarkSearch& landmarks() const { return landmarks_; }

 private:
  explicit FaceFinder(const LandmarkTable& table) : places_(table), landmarks_(table) {}

  PlaceSearch places_;
  LandmarkSearch landmarks_;
};

}  // namespace fbs
