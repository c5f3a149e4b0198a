#include "encoder/plan/knot_descent.h"

#include "bitstream/track.h"

namespace fbs {
namespace {

constexpr double kMinGain = 1e-6;  // squared luma levels; smaller is rounding

}  // namespace

KnotDescent::KnotDescent(const PlanTerms& terms, MotionGroup& group)
    : terms_(terms), group_(group), slope_(terms.cost.pictures()) {
  begin_slopes();
}

bool KnotDescent::sweep() {
  bool changed = false;
  for (std::size_t part = 0; part < kPartCount; ++part)
    if (coded(part)) changed = descend(part) || changed;
  for (std::size_t part = 0; part < kPartCount; ++part)
    if (coded(part)) changed = drop_knots(part) || changed;
  return changed;
}

Knot KnotDescent::before(std::size_t part, std::size_t k) const {
  return k == 0 ? anchor_knot(group_.anchor, part) : group_.tracks[part][k - 1];
}

const Knot* KnotDescent::after(std::size_t part, std::size_t k) const {
  const Track& track = group_.tracks[part];
  return k + 1 < track.size() ? &track[k + 1] : nullptr;
}

KnotDescent::Reach KnotDescent::reach(std::size_t part, std::size_t k) const {
  const Knot* next = after(part, k);
  const int knot = group_.tracks[part][k].picture, low = before(part, k).picture;
  const int high = next != nullptr ? next->picture : knot + 1;
  return {low + 1, high - 1, knot, low, high};
}

PartPoint KnotDescent::value_at(std::size_t part, int picture) const {
  Knot a = anchor_knot(group_.anchor, part);
  for (const Knot& b : group_.tracks[part]) {
    if (b.picture >= picture)
      return on_line(a.value, b.value, part,
                     static_cast<double>(picture - a.picture) / (b.picture - a.picture));
    a = b;
  }
  return {};
}

void KnotDescent::begin_slopes() {
  for (std::size_t t = 0; t < slope_.size(); ++t) {
    Row e{};
    for (std::size_t part = 0; part < kPartCount; ++part) {
      if (!coded(part)) continue;
      const PartPoint x = value_at(part, static_cast<int>(t));
      for (std::size_t k = 0, i = kPartFirst[part]; k < kPartSizes[part]; ++k, ++i)
        e[i] = x[k] - terms_.cost.target(t)[i];
    }
    for (std::size_t i = 0; i < kParameterCount; ++i) {
      const float* row = terms_.cost.quadratic(t) + i * kParameterCount;
      double sum = 0;
      for (std::size_t j = 0; j < kParameterCount; ++j) sum += static_cast<double>(row[j]) * e[j];
      slope_[t][i] = sum;
    }
  }
}

void KnotDescent::add_to_slope(int picture, std::size_t number, double change) {
  Row& slope = slope_[picture];
  const float* row = terms_.cost.quadratic(picture) + number * kParameterCount;
  for (std::size_t j = 0; j < kParameterCount; ++j) slope[j] += change * static_cast<double>(row[j]);
}

void KnotDescent::move(std::size_t part, std::size_t k, std::size_t place, std::int32_t by) {
  group_.tracks[part][k].value[place] += by;
  const Reach r = reach(part, k);
  for (int t = r.first; t <= r.last; ++t) add_to_slope(t, kPartFirst[part] + place, by * r.share(t));
}

/// Bits of the spans that end and begin at knot k.
double KnotDescent::bits_around(std::size_t part, std::size_t k) const {
  const Knot& knot = group_.tracks[part][k];
  double bits = terms_.rate.knot(part, before(part, k), knot, group_.pictures);
  if (const Knot* next = after(part, k)) bits += terms_.rate.knot(part, knot, *next, group_.pictures);
  return bits;
}

/// Change of the distortion when the numbers of knot k become `to`.
double KnotDescent::distortion_change(std::size_t part, std::size_t k, const PartValues& to) const {
  const PartValues& from = group_.tracks[part][k].value;
  const std::size_t first = kPartFirst[part];
  const Reach r = reach(part, k);
  std::array<std::size_t, kMaxPartSize> moved;
  std::size_t count = 0;
  for (std::size_t p = 0; p < kPartSizes[part]; ++p)
    if (to[p] != from[p]) moved[count++] = p;
  double sum = 0;
  for (int t = r.first; t <= r.last; ++t) {
    const double share = r.share(t);
    const float* quadratic = terms_.cost.quadratic(t);
    const Row& slope = slope_[t];
    for (std::size_t a = 0; a < count; ++a) {
      const std::size_t i = first + moved[a];
      const double da = share * (to[moved[a]] - from[moved[a]]);
      double along = 2 * slope[i];
      for (std::size_t b = 0; b < count; ++b)
        along += share * (to[moved[b]] - from[moved[b]]) *
                 static_cast<double>(quadratic[i * kParameterCount + first + moved[b]]);
      sum += da * along;
    }
  }
  return sum;
}

bool KnotDescent::try_values(std::size_t part, std::size_t k, const PartValues& to) {
  Knot& knot = group_.tracks[part][k];
  if (to == knot.value) return false;
  const double distortion = distortion_change(part, k, to);
  const double bits = bits_around(part, k);
  const PartValues from = knot.value;
  knot.value = to;
  const double more_bits = bits_around(part, k) - bits;
  knot.value = from;
  if (distortion + terms_.lambda * more_bits >= -kMinGain) return false;
  for (std::size_t p = 0; p < kPartSizes[part]; ++p)
    if (to[p] != from[p]) move(part, k, p, to[p] - from[p]);
  return true;
}

bool KnotDescent::try_number(std::size_t part, std::size_t k, std::size_t place, std::int32_t value) {
  const std::size_t i = kPartFirst[part] + place;
  if (value < terms_.limits.min[i] || value > terms_.limits.max[i]) return false;
  PartValues to = group_.tracks[part][k].value;
  to[place] = value;
  return try_values(part, k, to);
}

bool KnotDescent::falls_upwards(std::size_t part, std::size_t k, std::size_t place) const {
  const Reach r = reach(part, k);
  double slope = 0;
  for (int t = r.first; t <= r.last; ++t) slope += r.share(t) * slope_[t][kPartFirst[part] + place];
  return slope < 0;
}

/// Tries for every number of every knot one step downhill, or its neighbours' value, which costs no bits.
bool KnotDescent::descend(std::size_t part) {
  bool changed = false;
  for (std::size_t k = 0; k < group_.tracks[part].size(); ++k) {
    const PartValues low = before(part, k).value;
    changed = try_values(part, k, low) || changed;
    if (const Knot* next = after(part, k)) changed = try_values(part, k, PartValues(next->value)) || changed;
    for (std::size_t p = 0; p < kPartSizes[part]; ++p) {
      const std::int32_t now = group_.tracks[part][k].value[p];
      changed = try_number(part, k, p, now + (falls_upwards(part, k, p) ? 1 : -1)) || changed;
      changed = try_number(part, k, p, low[p]) || changed;
      if (const Knot* next = after(part, k)) changed = try_number(part, k, p, next->value[p]) || changed;
    }
  }
  return changed;
}

/// Change of the distortion in one picture when a part's numbers change by `by`.
double KnotDescent::distortion_change_at(std::size_t part, int picture, const PartPoint& by) const {
  const std::size_t first = kPartFirst[part];
  const float* quadratic = terms_.cost.quadratic(picture);
  double sum = 0;
  for (std::size_t p = 0; p < kPartSizes[part]; ++p) {
    const std::size_t i = first + p;
    double along = 2 * slope_[picture][i];
    for (std::size_t q = 0; q < kPartSizes[part]; ++q)
      along += by[q] * static_cast<double>(quadratic[i * kParameterCount + first + q]);
    sum += by[p] * along;
  }
  return sum;
}

/// Drops an inner knot where one straight span costs less than two.
bool KnotDescent::drop_knot(std::size_t part, std::size_t k) {
  Track& track = group_.tracks[part];
  const Knot a = before(part, k), b = track[k], c = track[k + 1];
  double distortion = 0;
  std::vector<PartPoint> changes;
  for (int t = a.picture + 1; t < c.picture; ++t) {
    const auto share = [&](const Knot& from, const Knot& to) {
      return static_cast<double>(t - from.picture) / (to.picture - from.picture);
    };
    const PartPoint is = t <= b.picture ? on_line(a.value, b.value, part, share(a, b))
                                        : on_line(b.value, c.value, part, share(b, c));
    PartPoint change = on_line(a.value, c.value, part, share(a, c));
    for (std::size_t p = 0; p < kPartSizes[part]; ++p) change[p] -= is[p];
    distortion += distortion_change_at(part, t, change);
    changes.push_back(change);
  }
  const double bits = terms_.rate.knot(part, a, c, group_.pictures) -
                      terms_.rate.knot(part, a, b, group_.pictures) -
                      terms_.rate.knot(part, b, c, group_.pictures);
  if (distortion + terms_.lambda * bits >= 0) return false;
  for (int t = a.picture + 1; t < c.picture; ++t)
    for (std::size_t p = 0; p < kPartSizes[part]; ++p)
      if (const double by = changes[t - a.picture - 1][p]; by != 0) add_to_slope(t, kPartFirst[part] + p, by);
  track.erase(track.begin() + static_cast<std::ptrdiff_t>(k));
  return true;
}

bool KnotDescent::drop_knots(std::size_t part) {
  bool changed = false;
  for (std::size_t k = 0; k + 1 < group_.tracks[part].size();) {
    if (drop_knot(part, k))
      changed = true;
    else
      ++k;
  }
  return changed;
}

}  // namespace fbs
