#include "encoder/plan/span_search.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace fbs {
namespace {

/// Nodes are the anchor (0) and the pictures (t + 1); each has the values that a knot there would have.
class SpanSearch {
 public:
  SpanSearch(const PlanTerms& terms, std::size_t part, const PartValues& anchor)
      : terms_(terms), part_(part), nodes_(terms.cost.pictures()), best_(1 + nodes_) {
    value_.push_back(anchor);
    for (int t = 0; t < nodes_; ++t) value_.push_back(terms.cost.rounded(part, t, terms.limits));
  }

  Track solve() {
    best_[0].cost = 0;
    for (int from = 0; from < nodes_; ++from) extend(from);
    return trace_back();
  }

 private:
  struct BackPointer {
    double cost = std::numeric_limits<double>::max();
    int from = 0;
    int held_to = 0;  ///< node at which a jump begins; `from` when there is none
  };

  [[nodiscard]] double bits(int from, int values_of, int to) const {
    return terms_.lambda *
           terms_.rate.knot(part_, Knot{0, value_[from]}, Knot{to - 1, value_[values_of]}, nodes_);
  }

  /// Distortion of the pictures after node a up to node b, on the line from one node's values to another's.
  [[nodiscard]] double line_distortion(int a, const PartValues& from, int b, const PartValues& to) const {
    double sum = 0;
    for (int node = a + 1; node <= b; ++node) {
      const double share = static_cast<double>(node - a) / (b - a);
      sum += terms_.cost.distortion(part_, node - 1, on_line(from, to, part_, share));
    }
    return sum;
  }

  void offer(int node, double cost, int from, int held_to) {
    if (cost < best_[node].cost) best_[node] = {cost, from, held_to};
  }

  /// All spans that begin at a node.
  void extend(int from) {
    const double before = best_[from].cost;
    const PartPoint still = on_line(value_[from], value_[from], part_, 0);
    double held = 0;  // distortion of holding up to the picture before `to`
    for (int to = from + 1; to <= nodes_; ++to) {
      // Bits alone often rule out a span, and distortion takes far longer to sum.
      const double straight = before + bits(from, to, to);
      if (straight < best_[to].cost)
        offer(to, straight + line_distortion(from, value_[from], to, value_[to]), from, from);
      if (to - 1 > from) {
        const double jump = before + held + bits(from, from, to - 1) + bits(from, to, to);
        if (jump < best_[to].cost)
          offer(to, jump + line_distortion(to - 1, value_[from], to, value_[to]), from, to - 1);
      }
      held += terms_.cost.distortion(part_, to - 1, still);
    }
    const double hold = before + held + bits(from, from, nodes_);
    if (hold < end_.cost) end_ = {hold, from, nodes_};
  }

  [[nodiscard]] Track trace_back() const {
    Track track;
    int node = nodes_;
    if (end_.cost < best_[nodes_].cost) {
      track.push_back({nodes_ - 1, value_[end_.from]});
      node = end_.from;
    }
    while (node > 0) {
      const BackPointer& back = best_[node];
      track.push_back({node - 1, value_[node]});
      if (back.held_to > back.from) track.push_back({back.held_to - 1, value_[back.from]});
      node = back.from;
    }
    std::reverse(track.begin(), track.end());
    return track;
  }

  PlanTerms terms_;
  std::size_t part_;
  int nodes_;                      ///< index of the last one: the number of pictures
  std::vector<PartValues> value_;  ///< of each node
  std::vector<BackPointer> best_;  ///< cheapest path to a knot at each node
  BackPointer end_;                ///< holding to the end
};

}  // namespace

Track cheapest_spans(const PlanTerms& terms, std::size_t part, const PartValues& anchor) {
  return SpanSearch(terms, part, anchor).solve();
}

}  // namespace fbs
