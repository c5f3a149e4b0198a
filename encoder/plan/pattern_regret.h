// Decides when a pattern of a given quality pays although later pictures are unknown. With a bitrate
// PatternReplacement decides, which also chooses how fine it is.
#pragma once

#include <algorithm>

namespace fbs {

/// If later pictures are like those since the last pattern, the mean cost of a picture, errors and bits, is
/// least where a pattern is bought as soon as a picture costs more than that mean: the rule for replacing
/// what wears out (Barlow and Hunter, Optimum preventive maintenance policies, 1960). Errors that do not
/// grow, such as noise, buy nothing. If later pictures are not like them, as behind a change that stays, a
/// pattern is bought once a few times its price has been lost, as skis are bought (Karlin et al., Competitive
/// snoopy caching, 1988).
class PatternRegret {
 public:
  /// Starts a new pattern.
  /// @param error  of its own picture, drawn from it: squared luma levels, sum over the picture
  void begin(double error) {
    *this = {};
    least_ = error;
  }

  /// Adds the next picture.
  /// @param error  in its cheapest modes
  void add(double error) {
    const double loss = std::max(0.0, error - least_);
    lost_ += loss;
    ++pictures_;
    recent_ += kFollow * (loss - recent_);
  }

  /// @param bits      the pattern's size
  /// @param lambda    squared luma levels that a bit is worth
  /// @param patience  prices, at least 1, after whose loss a pattern is bought in any case. More favours the
  ///                  face, less the frame
  [[nodiscard]] bool pays(double bits, double lambda, double patience) const {
    const double price = lambda * bits;
    return pictures_ * recent_ - lost_ > price || lost_ > patience * price;
  }

 private:
  /// How fast the present loss follows that of pictures, which trembles.
  static constexpr double kFollow = 0.3;

  double least_ = 0;
  double lost_ = 0;
  double recent_ = 0;  ///< loss of a picture, smoothed
  int pictures_ = 0;   ///< since the pattern
};

}  // namespace fbs
