// What the next pattern of a live scene is expected to take.
#pragma once

#include <array>
#include <cstddef>
#include <map>

namespace fbs {

/// Bits, by quantiser, of libaom's scale 0..63. A pattern that earlier ones predict codes what has changed
/// since, and where its quantiser is finer than all of them, what they lack of the whole picture.
class PatternSizes {
 public:
  PatternSizes();
  /// What trials of a whole picture took, at one quantiser at least; set_whole() scales it.
  void set_tried(const std::map<int, std::size_t>& bytes);
  /// A scene's first pattern, or one after a cut: nothing predicts it.
  void set_whole(double bits, int quantiser);
  /// A pattern that earlier ones predict.
  /// @param age  pictures since the pattern before, at least 1
  void learn(double bits, int quantiser, std::size_t age);

  /// A whole picture.
  [[nodiscard]] double whole(int quantiser) const;
  /// What has changed after so many pictures, at least 1.
  [[nodiscard]] double change(int quantiser, std::size_t age) const;
  /// What the patterns so far lack.
  [[nodiscard]] double refinement(int quantiser) const;

 private:
  std::array<double, 64> log_whole_;  ///< natural logarithm of the bits of a whole picture
  double change_ = 0;                 ///< bits after one picture, at change_quantiser_; 0: unknown
  int change_quantiser_ = 0;
  int finest_ = 63;  ///< quantiser of the scene so far
};

}  // namespace fbs
