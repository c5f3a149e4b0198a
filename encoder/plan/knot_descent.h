// Optimises all parts of a group together: coordinate descent over knots and their numbers.
#pragma once

#include <vector>

#include "encoder/plan/span_search.h"

namespace fbs {

/// Lowers  distortion + lambda * bits  of a group, over all its parts at once, in whole steps. Keeps the
/// slope of the distortion in each picture up to date, so that a trial takes only a few products.
class KnotDescent {
 public:
  /// @param group  with a track for each part in terms.limits.parts; changed in place
  KnotDescent(const PlanTerms& terms, MotionGroup& group);

  /// One sweep over all parts; false when nothing changed.
  bool sweep();

 private:
  using Row = GroupCost::Row;
  /// Pictures that a knot affects, and how much.
  struct Reach {
    int first, last;      ///< pictures
    int knot, low, high;  ///< pictures of the knot and its neighbours
    [[nodiscard]] double share(int t) const {
      return t <= knot ? static_cast<double>(t - low) / (knot - low)
                       : static_cast<double>(high - t) / (high - knot);
    }
  };

  [[nodiscard]] bool coded(std::size_t part) const { return has_part(terms_.limits.parts, part); }
  [[nodiscard]] Knot before(std::size_t part, std::size_t k) const;
  [[nodiscard]] const Knot* after(std::size_t part, std::size_t k) const;
  [[nodiscard]] Reach reach(std::size_t part, std::size_t k) const;
  [[nodiscard]] PartPoint value_at(std::size_t part, int picture) const;

  void begin_slopes();
  void add_to_slope(int picture, std::size_t number, double change);

  // Numbers of a knot.
  bool descend(std::size_t part);
  bool try_values(std::size_t part, std::size_t k, const PartValues& to);
  bool try_number(std::size_t part, std::size_t k, std::size_t place, std::int32_t value);
  [[nodiscard]] bool falls_upwards(std::size_t part, std::size_t k, std::size_t place) const;
  [[nodiscard]] double distortion_change(std::size_t part, std::size_t k, const PartValues& to) const;
  [[nodiscard]] double bits_around(std::size_t part, std::size_t k) const;
  void move(std::size_t part, std::size_t k, std::size_t place, std::int32_t by);

  // Whole knots.
  bool drop_knots(std::size_t part);
  bool drop_knot(std::size_t part, std::size_t k);
  [[nodiscard]] double distortion_change_at(std::size_t part, int picture, const PartPoint& by) const;

  PlanTerms terms_;
  MotionGroup& group_;
  std::vector<Row> slope_;  ///< of each picture: quadratic * (x - target), half the gradient
};

}  // namespace fbs
