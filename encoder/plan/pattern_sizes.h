// What the next pattern of a live scene is expected to take.
#pragma once

#include <cstddef>

namespace fbs {

/// Bits, by quantiser, of libaom's scale 0..63. A pattern that earlier ones predict codes what has changed
/// since, and where its quantiser is finer than all of them, what they lack of the whole picture.
class PatternSizes {
 public:
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
  struct Size {
    double bits = 0;
    int quantiser = 0;
    [[nodiscard]] double at(int other_quantiser) const;
  };
  Size whole_;
  Size change_;      ///< after one picture; no bits: unknown
  int finest_ = 63;  ///< quantiser of the scene so far
};

}  // namespace fbs
