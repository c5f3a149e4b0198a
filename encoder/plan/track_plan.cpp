#include "encoder/plan/track_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bitstream/track.h"

namespace fbs {
namespace {

constexpr std::size_t kN = kParameterCount;
constexpr int kSweeps = 3;

/// A group while its knots are being chosen; all numbers in steps.
class Plan {
 public:
  Plan(const CodedState& anchor, std::span<const PictureCost> pictures, const cv::Mat1d& penalty,
       const std::array<double, kN>& step, const CodedLimits& limits, double lambda, const TrackRate& rate)
      : limits_(limits), lambda_(lambda), rate_(rate), pictures_(static_cast<int>(pictures.size())) {
    group_.anchor = anchor;
    group_.pictures = pictures_;
    target_.resize(pictures.size());
    form_.resize(pictures.size());
    slope_.resize(pictures.size());
    for (std::size_t t = 0; t < pictures.size(); ++t) {
      cv::Mat1d quadratic = pictures[t].quadratic();
      if (!penalty.empty()) quadratic += penalty;
      form_[t].resize(kN * kN);
      for (std::size_t i = 0; i < kN; ++i) {
        target_[t][i] = pictures[t].fit[i] / step[i];
        for (std::size_t j = 0; j < kN; ++j)
          form_[t][i * kN + j] =
              static_cast<float>(quadratic(static_cast<int>(i), static_cast<int>(j)) * step[i] * step[j]);
      }
    }
  }

  MotionGroup solve() {
    for (std::size_t part = 0; part < kPartCount; ++part)
      if (coded(part)) chain(part);
    begin_slopes();
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      bool changed = false;
      for (std::size_t part = 0; part < kPartCount; ++part)
        if (coded(part)) changed = descend(part) || changed;
      for (std::size_t part = 0; part < kPartCount; ++part)
        if (coded(part)) changed = drop_knots(part) || changed;
      if (!changed) break;
    }
    return std::move(group_);
  }

 private:
  using Values = std::array<std::int32_t, kMaxPartSize>;
  using Row = std::array<double, kN>;

  [[nodiscard]] bool coded(std::size_t part) const { return (limits_.parts >> part & 1) != 0; }
  static std::size_t first(std::size_t part) { return kPartFirst[part]; }
  static std::size_t size(std::size_t part) { return kPartSizes[part]; }

  [[nodiscard]] Knot anchor_of(std::size_t part) const { return anchor_knot(group_.anchor, part); }

  /// The fit at a picture in whole steps, within the limits.
  [[nodiscard]] Values rounded(std::size_t part, std::size_t t) const {
    Values v{};
    for (std::size_t k = 0; k < size(part); ++k) {
      const std::size_t i = first(part) + k;
      v[k] = static_cast<std::int32_t>(
          std::clamp<double>(std::round(target_[t][i]), limits_.min[i], limits_.max[i]));
    }
    return v;
  }

  /// Distortion of one part alone at picture t, the others being where the fit has them.
  [[nodiscard]] double distortion(std::size_t part, std::size_t t,
                                  const std::array<double, kMaxPartSize>& x) const {
    const std::size_t n = size(part), f = first(part);
    std::array<float, kMaxPartSize> e;
    for (std::size_t k = 0; k < n; ++k) e[k] = static_cast<float>(x[k] - target_[t][f + k]);
    float sum = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const float* row = &form_[t][(f + k) * kN + f];
      float dot = 0;
      for (std::size_t l = 0; l < n; ++l) dot += row[l] * e[l];
      sum += dot * e[k];
    }
    return static_cast<double>(sum);
  }

  [[nodiscard]] double span_distortion(std::size_t part, int from, const Values& a, int to,
                                       const Values& b) const {
    double sum = 0;
    std::array<double, kMaxPartSize> x;
    for (int t = from + 1; t <= to; ++t) {
      const double share = static_cast<double>(t - from) / (to - from);
      for (std::size_t k = 0; k < size(part); ++k) x[k] = a[k] + (b[k] - a[k]) * share;
      sum += distortion(part, static_cast<std::size_t>(t), x);
    }
    return sum;
  }

  /// The cheapest chain of spans of one part through the rounded fits. From a knot a span goes straight to a
  /// later one, or holds and jumps to it within one picture, or holds to the end.
  void chain(std::size_t part) {
    const int n = pictures_;
    std::vector<Values> at;  // of picture t - 1
    at.push_back(anchor_of(part).value);
    for (int t = 0; t < n; ++t) at.push_back(rounded(part, static_cast<std::size_t>(t)));
    struct Way {
      double cost = std::numeric_limits<double>::max();
      int from = 0;
      int held_to = 0;  // where a jump begins; `from` when there is none
    };
    std::vector<Way> best(static_cast<std::size_t>(n) + 1);
    best[0] = {0, 0, 0};
    Way end;  // holding to the end
    const auto value = [&](int k) -> const Values& { return at[k]; };
    const auto bits = [&](const Values& a, const Values& b, int to) {
      return lambda_ * rate_.knot(part, Knot{0, a}, Knot{to - 1, b}, n);
    };
    for (int from = 0; from < n; ++from) {
      const double before = best[from].cost;
      double held = 0;
      for (int to = from + 1; to <= n; ++to) {
        const auto offer = [&](double cost, int held_to) {
          Way& w = best[to];
          if (cost < w.cost) w = {cost, from, held_to};
        };
        const double cost = before + bits(value(from), value(to), to);
        if (cost < best[to].cost)
          offer(cost + span_distortion(part, from - 1, value(from), to - 1, value(to)), from);
        // Held until the picture before `to`.
        if (to - 1 > from) {
          const double jump =
              before + held + bits(value(from), value(from), to - 1) + bits(value(from), value(to), to);
          if (jump < best[to].cost)
            offer(jump + span_distortion(part, to - 2, value(from), to - 1, value(to)), to - 1);
        }
        std::array<double, kMaxPartSize> x{};
        std::copy(value(from).begin(), value(from).end(), x.begin());
        held += distortion(part, static_cast<std::size_t>(to - 1), x);
      }
      const double hold = before + held + bits(value(from), value(from), n);
      if (hold < end.cost) end = {hold, from, n};
    }
    Track& track = group_.tracks[part];
    int k = n;
    if (end.cost < best[n].cost) {
      track.push_back({n - 1, value(end.from)});
      k = end.from;
    }
    while (k > 0) {
      const Way& w = best[k];
      track.push_back({k - 1, value(k)});
      if (w.held_to > w.from) track.push_back({w.held_to - 1, value(w.from)});
      k = w.from;
    }
    std::reverse(track.begin(), track.end());
  }

  /// Slopes of the distortion: form * (x - target), of every picture.
  void begin_slopes() {
    for (std::size_t t = 0; t < slope_.size(); ++t) {
      Row e{};
      for (std::size_t part = 0; part < kPartCount; ++part) {
        if (!coded(part)) continue;
        const auto x = value_at(part, static_cast<int>(t));
        for (std::size_t k = 0; k < size(part); ++k) e[first(part) + k] = x[k] - target_[t][first(part) + k];
      }
      for (std::size_t i = 0; i < kN; ++i) {
        double sum = 0;
        for (std::size_t j = 0; j < kN; ++j) sum += static_cast<double>(form_[t][i * kN + j]) * e[j];
        slope_[t][i] = sum;
      }
    }
  }

  [[nodiscard]] std::array<double, kMaxPartSize> value_at(std::size_t part, int picture) const {
    Knot a = anchor_of(part);
    for (const Knot& b : group_.tracks[part]) {
      if (b.picture >= picture) {
        const double share = static_cast<double>(picture - a.picture) / (b.picture - a.picture);
        std::array<double, kMaxPartSize> x{};
        for (std::size_t k = 0; k < size(part); ++k) x[k] = a.value[k] + (b.value[k] - a.value[k]) * share;
        return x;
      }
      a = b;
    }
    return {};
  }

  [[nodiscard]] Knot before(std::size_t part, std::size_t k) const {
    return k == 0 ? anchor_of(part) : group_.tracks[part][k - 1];
  }
  [[nodiscard]] const Knot* after(std::size_t part, std::size_t k) const {
    const Track& track = group_.tracks[part];
    return k + 1 < track.size() ? &track[k + 1] : nullptr;
  }

  /// Pictures on which a knot acts, and how much.
  struct Reach {
    int first, last;
    int knot, low, high;  // pictures of the knot and its neighbours
    [[nodiscard]] double share(int t) const {
      return t <= knot ? static_cast<double>(t - low) / (knot - low)
                       : static_cast<double>(high - t) / (high - knot);
    }
  };
  [[nodiscard]] Reach reach(std::size_t part, std::size_t k) const {
    const Knot* next = after(part, k);
    const int knot = group_.tracks[part][k].picture, low = before(part, k).picture;
    const int high = next != nullptr ? next->picture : knot + 1;
    return {low + 1, high - 1, knot, low, high};
  }

  void move(std::size_t part, std::size_t k, std::size_t place, std::int32_t by) {
    group_.tracks[part][k].value[place] += by;
    const Reach r = reach(part, k);
    const std::size_t i = first(part) + place;
    for (int t = r.first; t <= r.last; ++t) {
      const double d = by * r.share(t);
      Row& slope = slope_[t];
      const float* row = &form_[t][i * kN];
      for (std::size_t j = 0; j < kN; ++j) slope[j] += d * static_cast<double>(row[j]);
    }
  }

  /// Bits of the spans that end at knot k and begin there.
  [[nodiscard]] double bits_round(std::size_t part, std::size_t k) const {
    const Knot& knot = group_.tracks[part][k];
    double bits = rate_.knot(part, before(part, k), knot, pictures_);
    if (const Knot* next = after(part, k)) bits += rate_.knot(part, knot, *next, pictures_);
    return bits;
  }

  /// Change of the distortion when numbers of knot k change.
  [[nodiscard]] double gain_of(std::size_t part, std::size_t k, const Values& to) const {
    const Values& from = group_.tracks[part][k].value;
    const Reach r = reach(part, k);
    std::array<std::size_t, kMaxPartSize> moved;
    std::size_t count = 0;
    for (std::size_t p = 0; p < size(part); ++p)
      if (to[p] != from[p]) moved[count++] = p;
    double sum = 0;
    for (int t = r.first; t <= r.last; ++t) {
      const double share = r.share(t);
      const float* form = form_[t].data();
      const Row& slope = slope_[t];
      for (std::size_t a = 0; a < count; ++a) {
        const std::size_t i = first(part) + moved[a];
        const double da = share * (to[moved[a]] - from[moved[a]]);
        double along = 2 * slope[i];
        for (std::size_t b = 0; b < count; ++b)
          along += share * (to[moved[b]] - from[moved[b]]) *
                   static_cast<double>(form[i * kN + first(part) + moved[b]]);
        sum += da * along;
      }
    }
    return sum;
  }

  bool try_values(std::size_t part, std::size_t k, const Values& to) {
    Knot& knot = group_.tracks[part][k];
    if (to == knot.value) return false;
    const double distortion = gain_of(part, k, to);
    const double bits = bits_round(part, k);
    const Values from = knot.value;
    knot.value = to;
    const double more = bits_round(part, k) - bits;
    knot.value = from;
    if (distortion + lambda_ * more >= -1e-6) return false;
    for (std::size_t p = 0; p < size(part); ++p)
      if (to[p] != from[p]) move(part, k, p, to[p] - from[p]);
    return true;
  }

  /// Every number of every knot: one step either way, or as its neighbours have it.
  bool descend(std::size_t part) {
    bool changed = false;
    for (std::size_t k = 0; k < group_.tracks[part].size(); ++k) {
      const Values low = before(part, k).value;
      const Knot* next = after(part, k);
      changed = try_values(part, k, low) || changed;
      if (next != nullptr) changed = try_values(part, k, Values(next->value)) || changed;
      for (std::size_t p = 0; p < size(part); ++p) {
        const std::size_t i = first(part) + p;
        const auto offer = [&](std::int32_t value) {
          if (value < limits_.min[i] || value > limits_.max[i]) return;
          Values to = group_.tracks[part][k].value;
          to[p] = value;
          changed = try_values(part, k, to) || changed;
        };
        const std::int32_t now = group_.tracks[part][k].value[p];
        // Where the slope points, downhill.
        offer(now + (downhill(part, k, p) ? 1 : -1));
        offer(low[p]);
        if (const Knot* n = after(part, k)) offer(n->value[p]);
      }
    }
    return changed;
  }

  [[nodiscard]] bool downhill(std::size_t part, std::size_t k, std::size_t place) const {
    const Reach r = reach(part, k);
    double slope = 0;
    for (int t = r.first; t <= r.last; ++t) slope += r.share(t) * slope_[t][first(part) + place];
    return slope < 0;
  }

  /// Drops inner knots where straight on costs less.
  bool drop_knots(std::size_t part) {
    bool changed = false;
    Track& track = group_.tracks[part];
    for (std::size_t k = 0; k + 1 < track.size();) {
      const Knot a = before(part, k), b = track[k], c = track[k + 1];
      double distortion = 0;
      std::vector<std::array<double, kMaxPartSize>> shifts;
      for (int t = a.picture + 1; t < c.picture; ++t) {
        const double direct = static_cast<double>(t - a.picture) / (c.picture - a.picture);
        const double bent = t <= b.picture ? static_cast<double>(t - a.picture) / (b.picture - a.picture)
                                           : static_cast<double>(t - b.picture) / (c.picture - b.picture);
        std::array<double, kMaxPartSize> d{};
        for (std::size_t p = 0; p < size(part); ++p) {
          const double is = t <= b.picture ? a.value[p] + (b.value[p] - a.value[p]) * bent
                                           : b.value[p] + (c.value[p] - b.value[p]) * bent;
          d[p] = a.value[p] + (c.value[p] - a.value[p]) * direct - is;
        }
        distortion += shifted(part, t, d);
        shifts.push_back(d);
      }
      const double bits = rate_.knot(part, a, c, pictures_) - rate_.knot(part, a, b, pictures_) -
                          rate_.knot(part, b, c, pictures_);
      if (distortion + lambda_ * bits < 0) {
        for (int t = a.picture + 1; t < c.picture; ++t) shift_slope(part, t, shifts[t - a.picture - 1]);
        track.erase(track.begin() + static_cast<std::ptrdiff_t>(k));
        changed = true;
      } else {
        ++k;
      }
    }
    return changed;
  }

  /// Change of the distortion at picture t when a part's numbers change by d there.
  [[nodiscard]] double shifted(std::size_t part, int t, const std::array<double, kMaxPartSize>& d) const {
    const float* form = form_[t].data();
    const Row& slope = slope_[t];
    double sum = 0;
    for (std::size_t p = 0; p < size(part); ++p) {
      const std::size_t i = first(part) + p;
      double along = 2 * slope[i];
      for (std::size_t q = 0; q < size(part); ++q)
        along += d[q] * static_cast<double>(form[i * kN + first(part) + q]);
      sum += d[p] * along;
    }
    return sum;
  }

  void shift_slope(std::size_t part, int t, const std::array<double, kMaxPartSize>& d) {
    Row& slope = slope_[t];
    for (std::size_t p = 0; p < size(part); ++p) {
      if (d[p] == 0) continue;
      const float* row = &form_[t][(first(part) + p) * kN];
      for (std::size_t j = 0; j < kN; ++j) slope[j] += d[p] * static_cast<double>(row[j]);
    }
  }

  const CodedLimits& limits_;
  double lambda_;
  const TrackRate& rate_;
  int pictures_;
  MotionGroup group_;
  std::vector<Row> target_;
  std::vector<std::vector<float>> form_;  // kN x kN of each picture
  std::vector<Row> slope_;
};

}  // namespace

TrackPlanner::TrackPlanner(const QuantiserSteps& steps, PartMask parts, double lambda, cv::Mat1d penalty)
    : limits_(steps, parts), lambda_(lambda), penalty_(std::move(penalty)) {
  for (std::size_t i = 0; i < kParameterCount; ++i) step_[i] = step_of(steps, i);
}

MotionGroup TrackPlanner::plan(const CodedState& anchor, std::span<const PictureCost> pictures,
                               const TrackRate& rate) const {
  return Plan(anchor, pictures, penalty_, step_, limits_, lambda_, rate).solve();
}

}  // namespace fbs
