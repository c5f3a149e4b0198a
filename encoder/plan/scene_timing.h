// Divides a scene's pictures into groups.
#pragma once

#include <cstdint>

#include "common/picture.h"
#include "encoder/settings.h"

namespace fbs {

/// Pictures per second.
[[nodiscard]] inline double fps_of(const VideoFormat& format) {
  return static_cast<double>(format.frame_rate.num) / format.frame_rate.den;
}

struct SceneTiming {
  /// Most pictures from one place to join to the next; 0: a scene goes on where there is one pattern, and is
  /// a segment where there are several.
  std::uint64_t key_pictures;
  std::size_t group_pictures;      ///< pictures in a motion packet, after the first, which has its own
  int groups_per_key;              ///< every so many groups one needs no group before it
  bool repeats_moved;              ///< see MotionEncoder
  std::uint64_t lookahead;         ///< pictures observed before the scene's head is written
  std::uint32_t nominal_duration;  ///< of a picture, 1/90000 s

  SceneTiming(const VideoFormat& format, const EncoderSettings& settings);

  /// Whether a group ends with the picture pushed last. The scene's first picture is a group of its own, so
  /// that a viewer can start with it, and the last group ends with the scene.
  /// @param in_group  pictures of the group so far
  /// @param in_scene  pictures of the scene so far
  [[nodiscard]] bool group_ends(std::size_t in_group, std::uint64_t in_scene) const {
    return in_scene == 1 || in_group == group_pictures || in_scene == key_pictures;
  }
};

}  // namespace fbs
