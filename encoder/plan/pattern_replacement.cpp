#include "encoder/plan/pattern_replacement.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fbs {
namespace {

/// Assumed growth of the error of a talking head: to so many squared luma levels a sample, by 1 - 1/e within
/// so many pictures. Soon replaced by what is seen.
constexpr double kAssumedGrowth = 8, kAssumedPictures = 8;
constexpr std::size_t kAssumedLife = 60;

/// How fast expected growth follows lives, its share between patterns what is seen there, and the smoothed
/// error that of pictures, which trembles.
constexpr double kLearnGrowth = 0.3, kLearnBetween = 0.2, kFollow = 0.3;

/// Growth between two patterns, relative to that after one, until it has been seen.
constexpr double kAssumedBetween = 0.5;

/// Error of a pattern's own picture when the quantiser is one higher: 1.04 to 1.06 in akiyo and claire.
constexpr double kErrorPerStep = 1.045;

/// Longest interval, and the time in which what a pattern refines pays, since it lasts, s.
constexpr double kLongest = 3, kRefinementLasts = 5;

/// A head is still once the mean growth of errors over kStillFor seconds is below kStillGrowth times the
/// error of the pattern's own picture: it is .07 to .11 in generated talkers who only blink, .15 and more in
/// akiyo. A finer pattern is then assumed to last kStillLasts seconds.
constexpr double kStillFor = 2, kStillGrowth = 0.12, kStillLasts = 16;

/// A pattern is bought once the error exceeds that of its own picture by this share of what the choice costs
/// besides: patterns also serve the pictures before them. 1 loses .2 dB at 12 kbit/s, .6 .3 dB at 6 (face,
/// three clips).
constexpr double kPays = 0.7;

/// Two patterns at once take more time, and have to be cheaper by this factor. With 1 the faces of both
/// carphones lose .2 dB at 12 kbit/s and .3 and .6 at 24; their frames gain at most .1.
constexpr double kTwoAtOnce = 1.06;

/// Halvings of the logarithm of a price, and its range.
constexpr int kHalvings = 16;
constexpr double kLogCheapest = -2, kLogDearest = 20;

/// Growth of errors between two patterns: each picture is drawn from the nearer one.
/// @param sums  of the growth over the first pictures of a life
double growth_between(const std::vector<double>& sums, std::size_t interval) {
  return sums[(interval - 1) / 2] + sums[interval / 2];
}

/// Intervals to choose from, rising: half of `together`, then its multiples. (A third gains the frame .1 dB
/// and takes a tenth more time.)
std::vector<std::size_t> intervals(const PatternReplacement::Timing& timing, std::size_t longest) {
  const std::size_t together = timing.together;
  std::vector<std::size_t> out;
  if (timing.two_at_once && together > 1) out.push_back((together + 1) / 2);
  for (std::size_t t = together; t <= longest; t += together) out.push_back(t);
  return out;
}

}  // namespace

double PatternReplacement::Offers::bits_now(int quantiser, std::size_t age) const {
  return whole ? sizes.whole(quantiser)
               : sizes.change(quantiser, std::max<std::size_t>(age, 1)) + sizes.refinement(quantiser);
}

/// Choices by quantiser and interval.
struct PatternReplacement::Outlook {
  struct Entry {
    double error;   ///< mean of a picture
    Choice choice;  ///< its cost is not set
  };
  std::vector<Entry> entries;

  [[nodiscard]] std::optional<Choice> cheapest(double price) const {
    const auto cost = [&](const Entry& e) {
      return (e.error + price * e.choice.bits) * (e.choice.patterns > 1 ? kTwoAtOnce : 1);
    };
    const auto best = std::ranges::min_element(entries, {}, cost);
    if (best == entries.end()) return std::nullopt;
    Choice out = best->choice;
    out.cost = cost(*best);
    return out;
  }
};

PatternReplacement::PatternReplacement(double samples) : between_(kAssumedBetween), growth_(kAssumedLife) {
  for (std::size_t i = 0; i < kAssumedLife; ++i)
    growth_[i] = kAssumedGrowth * samples * (1 - std::exp(-static_cast<double>(i + 1) / kAssumedPictures));
}

void PatternReplacement::begin_scene() {
  base_ = recent_ = 0;
  life_.clear();
}

void PatternReplacement::begin(double error, int quantiser) {
  growth_.resize(std::max(growth_.size(), life_.size()), growth_.back());
  for (std::size_t i = 0; i < life_.size(); ++i) growth_[i] += kLearnGrowth * (life_[i] - growth_[i]);
  life_.clear();
  base_ = recent_ = error;
  quantiser_ = quantiser;
}

void PatternReplacement::add(double error) {
  const double growth = std::max(0.0, error - base_);
  life_.push_back(growth);
  recent_ += kFollow * (base_ + growth - recent_);
}

void PatternReplacement::learn_between(double error, std::size_t pictures) {
  const double after = growth_between(expected_growth(pictures), pictures);
  if (after <= 0) return;
  const double share = (error - base_) * static_cast<double>(pictures) / after;
  between_ += kLearnBetween * (std::clamp(share, 0.0, 2.0) - between_);
}

std::vector<double> PatternReplacement::expected_growth(std::size_t pictures) const {
  std::vector<double> sums(pictures + 1);
  double growth = 0;
  for (std::size_t i = 0; i < pictures; ++i) {
    if (i < life_.size())
      growth = i < growth_.size() ? 0.5 * (life_[i] + growth_[i]) : life_[i];
    else if (i < growth_.size())
      growth = std::max(growth, growth_[i]);
    sums[i + 1] = sums[i] + growth;
  }
  return sums;
}

PatternReplacement::Outlook PatternReplacement::outlook(const Offers& offers, const Timing& timing) const {
  const auto longest = std::max(timing.together, static_cast<std::size_t>(kLongest * timing.per_second));
  const std::vector<double> sums = expected_growth(longest);
  const std::vector<std::size_t> possible = intervals(timing, longest);
  Outlook out;
  for (int q = 0; q <= 63; ++q) {
    const double refinement = offers.whole ? 0 : offers.sizes.refinement(q);
    const double own = base_ * std::pow(kErrorPerStep, q - quantiser_);
    const double one = offers.bits_now(q, age());
    for (const std::size_t t : possible) {
      const bool two = t < timing.together;
      const double bits_now = two ? offers.bits_now(q, t) + offers.sizes.change(q, t) : one;
      if (bits_now > offers.most_bits) continue;
      const double change = offers.whole ? offers.sizes.whole(q) : offers.sizes.change(q, t);
      // The last pictures of a life lie between two patterns.
      const std::size_t known = std::min(timing.known, t);
      const double growth = sums[t - known] + between_ * growth_between(sums, known);
      const auto pictures = static_cast<double>(t);
      const double bits = change / pictures + refinement / (kRefinementLasts * timing.per_second);
      out.entries.push_back({.error = own + growth / pictures,
                             .choice = {.quantiser = q,
                                        .interval = t,
                                        .patterns = two ? std::size_t{2} : 1,
                                        .cost = 0,
                                        .own = own,
                                        .bits = bits,
                                        .bits_now = bits_now}});
    }
  }
  return out;
}

std::optional<PatternReplacement::Choice> PatternReplacement::at_price(double price, const Offers& offers,
                                                                       const Timing& timing) const {
  return outlook(offers, timing).cheapest(price);
}

double PatternReplacement::price_of(double bits, const Offers& offers, const Timing& timing) const {
  const Outlook out = outlook(offers, timing);
  double cheap = kLogCheapest, dear = kLogDearest;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::midpoint(cheap, dear);
    const auto choice = out.cheapest(std::exp(middle));
    (choice && choice->bits > bits ? cheap : dear) = middle;
  }
  return std::exp(dear);
}

bool PatternReplacement::pays(const Choice& choice, double error) const {
  const double share = age() < choice.interval ? kPays : 0;
  return error > choice.own + share * (choice.cost - choice.own);
}

std::optional<int> PatternReplacement::finer(double price, const PatternSizes& sizes,
                                             double per_second) const {
  const auto pictures = static_cast<double>(age());
  const double grown = std::accumulate(life_.begin(), life_.end(), 0.0);
  if (pictures < kStillFor * per_second || grown > kStillGrowth * pictures * base_) return std::nullopt;
  const auto gain = [&](int q) {
    const double error = base_ * (1 - std::pow(kErrorPerStep, q - quantiser_));
    return error * kStillLasts * per_second - price * (sizes.whole(q) - sizes.whole(quantiser_));
  };
  int best = quantiser_;
  for (int q = 0; q < quantiser_; ++q)
    if (gain(q) > gain(best)) best = q;
  return best < quantiser_ ? std::optional(best) : std::nullopt;
}

}  // namespace fbs
