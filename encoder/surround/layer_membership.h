// Membership of a place of the surround: head, body or ground.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

#include "bitstream/syntax.h"
#include "encoder/model/pose.h"

namespace fbs {

inline constexpr std::size_t kLayerCount = 3;
enum Layer : std::uint8_t { kHeadLayer, kBodyLayer, kGroundLayer };

/// One number for each layer.
using LayerShares = std::array<float, kLayerCount>;

/// Spatial prior of a place near a head in this pose, before anything has moved; sum 1.
/// @param place  pixels of the picture
[[nodiscard]] LayerShares layers_by_place(const Pose& seen, glm::dvec2 place);

/// Shares of a place by a map, interpolated between its points; sum 1.
/// @param place  share of the picture's width and height
[[nodiscard]] LayerShares layers_by_map(const SurroundMap& map, glm::dvec2 place);

/// Membership of one keypoint. It starts from a prior by place or map and is refined from residuals: layers
/// as in Jepson and Black, Mixture models for optical flow computation, 1993.
class LayerMembership {
 public:
  LayerMembership() = default;
  explicit LayerMembership(const LayerShares& by_place) : prior_(by_place), share_(by_place) { update(); }

  /// @param by_map  replaces the prior; the residuals so far still count
  void set_map(const LayerShares& by_map);

  /// Adds the residual of a layer's motion in a picture, grey levels.
  /// @param rate  share of this picture in the running mean
  void observe(Layer layer, double residual, float rate);
  /// Marks the place as invisible where the layer's motion takes it.
  void observe_hidden(Layer layer) { visible_[layer] = 0; }
  /// Updates the weights by all layers' residuals.
  void update();

  /// Posterior; sum 1.
  [[nodiscard]] const LayerShares& weight() const { return weight_; }
  [[nodiscard]] double weight(Layer layer) const { return static_cast<double>(weight_[layer]); }
  [[nodiscard]] const LayerShares& prior() const { return prior_; }
  /// Shares by prior or map, as in the decoder's motion.
  [[nodiscard]] const LayerShares& share() const { return share_; }
  /// Robust weight of the last picture's residual: how surely the layer is seen there.
  [[nodiscard]] const LayerShares& visible() const { return visible_; }

 private:
  LayerShares prior_{};
  LayerShares mean_cost_{};  ///< running mean of the robust residual cost, squared grey levels
  LayerShares weight_{};
  LayerShares share_{};
  LayerShares visible_{};
};

}  // namespace fbs
