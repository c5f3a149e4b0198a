// Decoded pictures of the person that others are drawn from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <vector>

#include "common/picture.h"
#include "common/state.h"
#include "decoder/animate/scene_geometry.h"
#include "decoder/atlas/head_atlas.h"
#include "decoder/field/padded_plane.h"

namespace fbs {

/// A decoded picture of the person, and everything needed to draw from it.
struct Pattern {
  std::int32_t slot = 0;  ///< its place in the store
  Picture picture;
  State seen;                           ///< the state it was seen in
  TextureMesh texture;                  ///< of `seen` by the scene's geometry; empty without a face
  std::optional<PaddedPicture> padded;  ///< `picture`, to be warped; none without geometry
  HeadAtlas atlas;                      ///< the head that it shows; empty without a face

  void set_geometry(const SceneGeometry& geometry);
};

/// @param geometry  the scene's; none: a scene without a face
[[nodiscard]] Pattern make_pattern(Picture picture, const State& seen,
                                   const std::optional<SceneGeometry>& geometry);

/// The same from a coded picture, which has the setup's contrast.
[[nodiscard]] Pattern make_coded_pattern(Picture coded, const State& seen,
                                         const std::optional<SceneGeometry>& geometry, const Setup& setup);

/// Patterns in a row. Copies share them: a pattern takes a megabyte and more at 720p.
class PatternList {
  using Shared = std::shared_ptr<const Pattern>;

 public:
  class Iterator {
   public:
    // NOLINTBEGIN(readability-identifier-naming): the standard's names
    using iterator_category = std::forward_iterator_tag;
    using value_type = Pattern;
    using difference_type = std::ptrdiff_t;
    using pointer = const Pattern*;
    using reference = const Pattern&;
    // NOLINTEND(readability-identifier-naming)

    Iterator() = default;
    explicit Iterator(std::vector<Shared>::const_iterator at) : at_(at) {}
    reference operator*() const { return **at_; }
    pointer operator->() const { return at_->get(); }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    Iterator operator++(int) { return Iterator(at_++); }
    bool operator==(const Iterator&) const = default;

   private:
    std::vector<Shared>::const_iterator at_;
  };

  [[nodiscard]] std::size_t size() const { return patterns_.size(); }
  [[nodiscard]] bool empty() const { return patterns_.empty(); }
  [[nodiscard]] const Pattern& operator[](std::size_t k) const { return *patterns_[k]; }
  [[nodiscard]] const Pattern& front() const { return *patterns_.front(); }
  [[nodiscard]] const Pattern& back() const { return *patterns_.back(); }
  [[nodiscard]] Iterator begin() const { return Iterator(patterns_.begin()); }
  [[nodiscard]] Iterator end() const { return Iterator(patterns_.end()); }

  void clear() { patterns_.clear(); }
  void push_back(Pattern pattern) { patterns_.push_back(shared(std::move(pattern))); }
  void replace(std::size_t k, Pattern pattern) { patterns_[k] = shared(std::move(pattern)); }
  /// Puts a pattern into the place before which those of lower slots are, instead of one with the same slot.
  void store(Pattern pattern);
  /// Adds a pattern of another list, and shares it.
  void share(const PatternList& other, std::size_t k) { patterns_.push_back(other.patterns_[k]); }

 private:
  static Shared shared(Pattern pattern) { return std::make_shared<const Pattern>(std::move(pattern)); }

  std::vector<Shared> patterns_;
};

}  // namespace fbs
