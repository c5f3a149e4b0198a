// Fades in: detects a shot that begins dark and should begin again when its light has come.
#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core.hpp>

namespace fbs {

/// Watches a shot for light that comes up and stays: a fade from black, a lamp, an exposure that settles.
/// Patterns of the dark pictures are too coarse for the bright ones.
class FadeIn {
 public:
  /// The shot, or the scene, begins with the next picture.
  void begin() {
    seen_ = 0;
    rises_ = false;
  }

  /// Takes the next picture, all of one size: CutDetector::thumbnail().
  /// @return whether it shows the first picture's scene in much more light, which no longer rises. The next
  /// is then compared with this one.
  [[nodiscard]] bool has_ended(const cv::Mat1f& now);

  /// Whether there is much more light than in the first picture, and still more comes.
  [[nodiscard]] bool is_rising() const { return rises_; }

 private:
  static constexpr std::size_t kSettled = 6;  ///< pictures in which the light no longer rises

  cv::Mat1f first_;                          ///< reduced luma
  std::array<double, kSettled> contrast_{};  ///< of the last pictures, a ring
  std::size_t seen_ = 0;                     ///< pictures
  bool rises_ = false;
};

}  // namespace fbs
