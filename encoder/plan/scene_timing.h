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
  /// Most pictures from one place to join to the next, at the frame rate; 0: a scene goes on where there is
  /// one pattern, and is a segment where there are several.
  std::uint64_t key_pictures;
  std::uint64_t key_ticks;  ///< the same by time, 1/90000 s
  /// Pictures in a motion packet, after the first, which has its own. Live: at the frame rate.
  std::size_t group_pictures;
  /// Live: how long a group lasts, 1/90000 s, to the nearest picture; 0: as its number of pictures.
  std::uint64_t group_ticks;
  int groups_per_key;              ///< every so many groups one needs no group before it
  bool repeats_moved;              ///< see MotionEncoder
  std::uint64_t lookahead;         ///< pictures observed before the scene's head is written
  std::uint32_t nominal_duration;  ///< of a picture, 1/90000 s

  SceneTiming(const VideoFormat& format, const EncoderSettings& settings);

  /// Whether a group ends with the picture pushed last. The scene's first picture is a group of its own, so
  /// that a viewer can start with it, and the last group ends with the scene.
  /// @param in_group  pictures of the group so far
  /// @param lasts     the group so far, 1/90000 s
  /// @param last      its last picture, 1/90000 s
  /// @param in_scene  pictures of the scene so far
  [[nodiscard]] bool group_ends(std::size_t in_group, std::uint64_t lasts, std::uint32_t last,
                                std::uint64_t in_scene) const;

  /// Whether the scene is as long as it may be.
  /// @param lasts  the scene so far, 1/90000 s
  /// @param last   its last picture, 1/90000 s
  [[nodiscard]] bool scene_is_full(std::uint64_t lasts, std::uint32_t last) const;
};

}  // namespace fbs
