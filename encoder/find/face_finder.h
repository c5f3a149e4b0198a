// Finds the faces of a picture with their landmarks: landmarks are searched at the likeliest places, and what
// is believed is taken.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "common/picture.h"
#include "common/result.h"
#include "encoder/landmarks/landmark_search.h"
#include "encoder/landmarks/place_search.h"

namespace fbs {

/// A face that is believed.
struct FoundFace {
  FoundLandmarks landmarks;
  FacePlace place;  ///< by the landmarks
};

class FaceFinder {
 public:
  /// Belief from which a face is taken for one; and one that is small in its picture, of which there are many
  /// places. In a video the next pictures are as good, so that a face too many is worse than one missed: of
  /// 196 pictures without a face and 620 of text none is believed.
  static constexpr double kBelieved = 0.5, kBelievedIfSmall = 0.8;

  enum class Effort : std::uint8_t { kUsualSizes, kAllSizes };

  /// Errors of load_landmarks().
  static Result<FaceFinder> create();

  /// Faces whose eyes are a 15th to half of the picture's shorter side apart. The largest first, by size
  /// times belief.
  /// @param wanted  how many faces are asked for; a few more may be found
  /// @param effort  whether faces half as large are looked for, too, when fewer are found: three times as
  /// slow
  [[nodiscard]] std::vector<FoundFace> find(const Picture& picture, std::size_t wanted = 1,
                                            Effort effort = Effort::kAllSizes) const;

  /// Faces of certain sizes, in the same order.
  [[nodiscard]] std::vector<FoundFace> find(const Picture& picture, const EyeDistances& sizes,
                                            std::size_t wanted) const;

  [[nodiscard]] const LandmarkSearch& landmarks() const { return landmarks_; }

 private:
  explicit FaceFinder(const LandmarkTable& table) : places_(table), landmarks_(table) {}

  PlaceSearch places_;
  LandmarkSearch landmarks_;
};

}  // namespace fbs
