// How body and ground have moved since the first picture: the flat parts of the surround. Design section 4.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "bitstream/syntax.h"
#include "common/picture.h"
#include "encoder/model/picture_cost.h"
#include "encoder/model/pose.h"

namespace fbs {

/// What a place near a head seen like that belongs to, before anything has moved: head, body, ground; sum 1.
/// @param place  pixels of the picture
[[nodiscard]] std::array<float, 3> layers_by_place(const Pose& seen, glm::dvec2 place);

/// Finds the ways of body and ground from the first picture to each later one, not from one to the next, so
/// that nothing drifts. Each is a similarity about the head's origin, as State has it.
/// Method: spots of the first picture with a slope are aligned to the later picture by Gauss-Newton, coarse
/// to fine, with the weights of Geman and McClure (1987) for what is hidden or new; which spot belongs to
/// what is a guess by the head's place at first, and then learned from which way explains it in picture after
/// picture (layers as in Jepson and Black, Mixture models for optical flow computation, 1993). Works at a
/// long side of at most kLongSide whatever the size of the picture.
class SurroundMotion {
 public:
  /// @param first  the scene's first picture
  /// @param seen   its state
  SurroundMotion(const Picture& first, const State& seen);

  /// @param head  where it is in this picture
  void look_at(const Picture& picture, const Pose& head);

  /// What decides from now on how much of a spot goes with what.
  void believe(const SurroundMap& map);

  /// Puts what was seen in the last picture into a state, and what other ways of body and ground would cost
  /// into those of a picture.
  void add_to(State& state) const;
  void add_to(PictureCost& cost) const;

 private:
  static constexpr int kLongSide = 256;  ///< work pixels
  static constexpr int kLevels = 2;
  static constexpr std::size_t kLayers = 3;
  enum Layer : std::uint8_t { kHeadLayer, kBodyLayer, kGroundLayer };
  /// As State::body and State::ground, but in pixels.
  using Flat = std::array<double, kSimilarityCount>;

  struct Look {
    float value = 0, dx = 0, dy = 0;  ///< luma and its slope per work pixel of the level
  };
  /// The steepest place of a small square of the first picture.
  struct Spot {
    glm::dvec2 at{};         ///< work pixels, of pixel centres
    glm::dvec2 from_head{};  ///< eye distances
    std::array<Look, kLevels> look{};
    std::array<float, 3> steepness{};       ///< of the whole square: sums of dx dx, dx dy, dy dy
    std::array<float, kLayers> prior{};     ///< how likely it goes with what, by its place
    std::array<float, kLayers> against{};   ///< what later pictures said against that, on average
    std::array<float, kLayers> weight{};    ///< both together; sum 1
    std::array<float, kLayers> share{};     ///< that the map gives it
    std::array<float, kLayers> fits_now{};  ///< robust weight in the picture looked at
    bool rim = false;                       ///< near the picture's sides or top
  };

  [[nodiscard]] glm::dvec2 way_of(const Spot& spot, const Flat& flat) const;
  [[nodiscard]] Flat aligned(Layer layer, const Flat& start, const Flat& near) const;
  /// Weighted mean robust difference of a layer's spots.
  /// @param rim  only of spots near the picture's sides and top
  [[nodiscard]] double difference(Layer layer, const Flat& flat, bool rim = false) const;
  /// The way of body about `rest`, from where it was or, if that is of no use, from elsewhere.
  [[nodiscard]] Flat found_body(const Flat& rest, glm::dvec2 head_way) const;
  void weigh(Spot& spot) const;
  void learn(const Pose& head);

  int factor_ = 1;  ///< picture pixels per work pixel
  Pose seen_;
  double eye_px_;
  int width_, height_;
  std::vector<Spot> spots_;
  std::array<cv::Mat, kLevels> luma_;
  Flat body_{}, ground_{};              ///< as last aligned
  Flat shown_body_{}, shown_ground_{};  ///< as they are believed
  bool ground_shows_ = false;           ///< there is enough of it near the rim to say whether it moves
  bool ground_moves_ = false, body_moves_ = false;
  bool mapped_ = false;
  int pictures_ = 0;
};

}  // namespace fbs
