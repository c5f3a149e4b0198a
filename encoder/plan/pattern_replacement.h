// Decides when the next pattern is bought, and how fine it is, although later pictures are unknown.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "encoder/plan/pattern_sizes.h"

namespace fbs {

/// A pattern wears out: the more pictures lie between it and a picture, the larger the error. The next one
/// may also be finer. So it is replaced as machines are by better ones: as soon as a picture drawn without
/// the next pattern costs more than the mean over the next one's life, errors and bits, at the quantiser and
/// the length of life for which that mean is least (Terborgh, Dynamic Equipment Policy, 1949; Barlow and
/// Hunter, Optimum preventive maintenance policies, 1960). Errors are squared luma levels, sums over a
/// picture.
class PatternReplacement {
 public:
  /// The patterns to go on with.
  struct Choice {
    int quantiser;         ///< of the next
    std::size_t interval;  ///< pictures from one to the next
    std::size_t patterns;  ///< sent at once: two where the interval is half
    double cost;           ///< mean of a picture: its error, and its bits at their price
    double own;            ///< of that, the error of the next pattern's own picture
    double bits;           ///< mean of a picture
    double bits_now;       ///< sum over the patterns sent at once
  };
  /// What is known of sizes, and what limits them.
  struct Offers {
    const PatternSizes& sizes;
    double most_bits;    ///< limit for the patterns sent at once
    bool whole = false;  ///< nothing predicts the next one
    /// The next one's, when the last is this old.
    [[nodiscard]] double bits_now(int quantiser, std::size_t age) const;
  };
  /// Pictures as they are coded.
  struct Timing {
    /// Pictures from one decision to the next: intervals are multiples of it, or half. At least 1.
    std::size_t together;
    /// Pictures before a new pattern that are drawn from it, too; at least `together`.
    std::size_t known;
    double per_second;
    bool two_at_once = true;  ///< an interval may be half of `together`
  };

  /// @param samples  of a picture: what is assumed of errors until they are known is proportional to them
  explicit PatternReplacement(double samples);

  void begin_scene();
  /// A pattern has been bought.
  /// @param error  of its own picture, drawn from it
  void begin(double error, int quantiser);
  /// Adds the next picture, drawn without the next pattern.
  void add(double error);
  /// `pictures` between two patterns have been drawn from both.
  /// @param error  their mean, and the second pattern's own
  void learn_between(double error, std::size_t pictures);

  /// Pictures added since the last pattern.
  [[nodiscard]] std::size_t age() const { return life_.size(); }
  /// Error of a picture, smoothed.
  [[nodiscard]] double recent() const { return recent_; }

  /// The cheapest choice when a bit is worth `price`, squared luma levels; nothing: no offer is small enough.
  [[nodiscard]] std::optional<Choice> at_price(double price, const Offers& offers,
                                               const Timing& timing) const;
  /// The price at which the cheapest choice takes a mean of so many bits a picture, > 0, or a little less.
  [[nodiscard]] double price_of(double bits, const Offers& offers, const Timing& timing) const;
  /// Whether to replace the pattern now: it has lived as long as the choice plans, or fares worse than that.
  /// @param error  of the pictures next to the new pattern, drawn without it
  [[nodiscard]] bool pays(const Choice& choice, double error) const;
  /// With a fixed quantiser: the quantiser of a finer pattern, if the head has kept still and it pays.
  /// @param price  squared luma levels that a bit is worth
  [[nodiscard]] std::optional<int> finer(double price, const PatternSizes& sizes, double per_second) const;

 private:
  /// Sums of the expected growth of errors over the first pictures of a pattern's life.
  [[nodiscard]] std::vector<double> expected_growth(std::size_t pictures) const;
  struct Outlook;
  [[nodiscard]] Outlook outlook(const Offers& offers, const Timing& timing) const;

  double base_ = 0;    ///< error of the pattern's own picture
  int quantiser_ = 0;  ///< its
  double recent_ = 0;
  double between_;              ///< growth between two patterns, relative to that after one
  std::vector<double> life_;    ///< growth of the error, by picture since the pattern
  std::vector<double> growth_;  ///< the same over earlier lives
};

}  // namespace fbs
