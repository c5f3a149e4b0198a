#include "encoder/segment/live_patterns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "encoder/patterns/first_pattern.h"
#include "encoder/plan/pattern_point.h"
#include "encoder/plan/scene_timing.h"

namespace fbs {
namespace {

/// How much finer a scene's first pattern is: all others are predicted from it, and at first it is alone. In
/// a window it is not alone for long.
constexpr int kKeyBoost = 12, kWindowKeyBoost = 9;

/// The same with a rate: the room limits it.
constexpr int kRateBoost = 29;

/// It is replaced once there is room for a pattern of so many times its bytes. With 3 that comes later and is
/// no better (four clips at 5 kbit/s).
constexpr double kFiner = 2;

/// Patterns are to take at most these shares of the room, since they may be larger as they are sent: one that
/// is coded on trial, and one of which only the last ones tell.
constexpr double kTriedShare = 0.8, kExpectedShare = 0.65;

/// From this delay on, s, a segment is as long as the delay and can have several patterns.
constexpr double kWindowDelay = 0.7;
/// SolverSettings::pull: stronger than for files, since later windows are drawn from the patterns, too.
constexpr double kPull = 0.4;
/// What the patterns of such a segment must gain, relative to others, since fewer and finer ones pay; and
/// PatternRegret's patience. With 1 and 1 woman_presenter_700 takes 99 % more than a file in the face at one
/// second, with 2 and 4 47 % (unsolved). With 2, 4 and kKeyBoost foreman takes 44 and 51 % more in face and
/// frame, with these 13 and 23 %.
constexpr double kWindowPrice = 1.4, kWindowPatience = 4;

/// Most pictures that share errors in a draft, where windows are drafted or time is short: it takes 4 % less
/// of it at 640x480, and 2 to 3 % more of the rate.
constexpr std::size_t kDraftShared = 3;

/// Largest picture, in samples, that may have two patterns at once. At 1280x720 and 24 kbit/s they take 7 %
/// of the time and 30 MB; the faces and frames of two large clips change by 0 to .2 dB, to either side.
constexpr long long kMostForTwo = 640LL * 480;

/// Largest share of the buffer that a pattern may be planned to take, and s in which the price follows a
/// rate: at a steady price bits go where they gain most, and .3 dB are gained at 12 kbit/s.
constexpr double kMostOfBuffer = 0.5, kPriceFollows = 4;
/// Share of the buffer below which so little waits that the next group finds it empty.
constexpr double kIdle = 0.1;

/// Room for a scene's head is kept, since a new one can come at any time, but not more than this share. It
/// grows over this time, s: at the start of a scene a finer picture matters more.
constexpr double kMostKept = 0.4, kKeptFrom = 1;

/// Least share of the rate that patterns are planned for. With .2 akiyo loses 1.2 dB in the face at 3 kbit/s:
/// the price that a full buffer makes at first stays for seconds.
constexpr double kLeastShare = 0.35;

/// With strong resilience a group with a pattern is sent again in the next one, if that has none: with a rate
/// if this share of the buffer is left, without if the loss, weighted by this, costs more than the bits. With
/// 1 streams have 33 % more bytes and not 14, and 92 % of pictures within 1 dB at 10 % lost, not 90.
constexpr double kRepeatLeaves = 0.1, kLossWeight = 0.6;

/// Bytes of a group besides motion and patterns, about: blend, packet header.
constexpr double kGroupHeadBytes = 10;

/// Bits a second of motion until it has been seen, and how fast they follow it.
constexpr double kAssumedMotion = 1000, kFollowMotion = 0.3;

/// Viewers look at the face more than at the rest. With 3 against 1 it takes 4 % fewer bits at the same PSNR,
/// the frame as many.
constexpr double kFaceWeight = 3;

double weight_of(std::size_t region) {
  return region <= static_cast<std::size_t>(Region::kFace) ? kFaceWeight : 1;
}

double error_of(const ModeErrors& errors, const RegionModes& modes) {
  double sum = 0;
  for (std::size_t r = 0; r < kRegionCount; ++r)
    sum += weight_of(r) * errors[r][static_cast<std::size_t>(modes[r])];
  return sum;
}

double least_error(const ModeErrors& errors) {
  double sum = 0;
  for (std::size_t r = 0; r < kRegionCount; ++r)
    sum += weight_of(r) * *std::min_element(errors[r].begin(), errors[r].end());
  return sum;
}

/// The least error of each picture of a segment. Each run measures its first picture; the others are
/// interpolated.
std::vector<double> least_errors(const Segment& segment, const SegmentErrors& errors) {
  std::vector<double> out;
  for (auto run = errors.runs.begin(); run != errors.runs.end(); ++run) {
    const double first = least_error(run->errors);
    const bool goes_on = run + 1 != errors.runs.end() && !segment.is_cut(out.size() + run->pictures);
    const double next = goes_on ? least_error((run + 1)->errors) : first;
    for (std::size_t i = 0; i < run->pictures; ++i)
      out.push_back(std::lerp(first, next, static_cast<double>(i) / static_cast<double>(run->pictures)));
  }
  return out;
}

}  // namespace

LivePatterns::LivePatterns(PatternStage& stage, const LivePatternSettings& settings)
    : PatternPolicy(stage),
      settings_(settings),
      sequence_(store_.format(), settings.reduced, settings.alone),
      motion_(kAssumedMotion),
      replacement_(1.0 * store_.format().width * store_.format().height) {
  if (settings.bitrate_kbps > 0) rate_.emplace(settings.bitrate_kbps, settings.buffer);
}

void LivePatterns::begin_scene() {
  sequence_.begin_scene();
  replacement_.begin_scene();
  regret_ = {};
  since_pattern_ = 0;
  next_slot_ = 0;
  coarse_ = 0;
  with_pattern_.clear();
}

bool LivePatterns::segment_ends(std::size_t next) const {
  if (!has_windows(settings_.delay) || stage_.pictures() + kMaxGroupPictures > kMaxWaitingPictures)
    return true;
  // So many whole groups as are nearest to the delay, besides a scene's first.
  const double end = settings_.delay * fps_of(store_.format()) + 1;
  return store_.seconds() * fps_of(store_.format()) + 0.5 * static_cast<double>(next) > end;
}

bool LivePatterns::has_windows(double delay) {
  return delay >= kWindowDelay;
}

double LivePatterns::room() const {
  return rate_ ? rate_->room() : std::numeric_limits<double>::infinity();
}

double LivePatterns::first_room() const {
  if (!rate_) return std::numeric_limits<double>::infinity();
  const bool in_time = !stage_.begun() && settings_.start > 0;
  return (in_time ? rate_->room(settings_.start) : rate_->room()) - kPatternHeadBytes -
         static_cast<double>(store_.segment().groups.front().payload.size());
}

double LivePatterns::pattern_room() const {
  double kept = 0;
  if (rate_ && coarse_ == 0)
    kept = std::min(1.0, age_ / kKeptFrom) * std::min(head_, kMostKept * rate_->capacity());
  return room() - kept - kPatternHeadBytes - store_.motion_bytes();
}

Result<int> LivePatterns::key_quantiser(const Scene& scene, std::size_t time, double room) {
  const int key_boost = rate_ ? kRateBoost : has_windows(settings_.delay) ? kWindowKeyBoost : kKeyBoost;
  // What takes the place of a coarse pattern is as fine as that was to be.
  if (coarse_ == 0) wanted_ = std::max(0, std::clamp(settings_.quantiser, 0, kMaxQuantiser) - key_boost);
  if (!rate_) return wanted_;
  const auto source = store_.segment().pictures.read(time);
  if (!source) return fail(source.error());
  Picture picture = *source;
  store_.reduce_contrast(scene, time, picture);
  const Picture coded = sequence_.to_coded_size(std::move(picture));
  FirstPattern trial(sequence_.coded_format(), coded, kTrialSpeed);
  auto quantiser = trial.finest_within(static_cast<std::size_t>(std::max(0.0, kTriedShare * room)), wanted_);
  if (!quantiser) return quantiser;
  if (auto bytes = trial.bytes(*quantiser); !bytes) return fail(bytes.error());
  sizes_.set_tried(trial.tried());
  return quantiser;
}

Result<LivePatterns::Plan> LivePatterns::plan_first(const Scene& scene) {
  const double fits = first_room();
  auto quantiser = key_quantiser(scene, 0, std::min(fits, pattern_room()));
  if (!quantiser) return fail(quantiser.error());
  Plan plan{{0}, *quantiser, std::min(settings_.quantiser, kMaxQuantiser), true};
  double key = sizes_.whole(*quantiser) / 8;
  double left = pattern_room() - key;
  if (key > fits && !settings_.reduced) {  // even at its coarsest
    const double coarse = std::max(fits, 0.0);
    plan.start = static_cast<std::size_t>(coarse);
    left = pattern_room() - coarse;
    if (store_.segment().states.size() == 1 || left < kFiner * coarse) return plan;
    quantiser = key_quantiser(scene, 1, left);
    if (!quantiser) return fail(quantiser.error());
    plan.times.push_back(1);
    plan.first = *quantiser;
    key = sizes_.whole(*quantiser) / 8;
    left -= key;
  }
  if (store_.segment().states.size() == 1) return plan;
  auto draft = SegmentDraft::of_sources(store_, plan.times, 0);
  if (!draft) return fail(draft.error());
  SequenceSettings trial;
  trial.quantiser = plan.first;
  trial.speed = kTrialSpeed;
  trial.boost = 0;
  trial.reduced = settings_.reduced;
  if (auto tried = draft->code(store_, scene, trial, workers_); !tried) return fail(tried.error());
  sizes_.set_whole(8.0 * static_cast<double>(draft->coded.front().av1.size()), plan.first);
  if (auto measured = stage_.measure(draft->usable(scene), 1); !measured) return fail(measured.error());
  const std::vector<double> least = least_errors(store_.segment(), std::exchange(stage_.errors(), {}));
  replacement_.begin(least.front(), plan.first);
  regret_.begin(least.front());
  add_paying(least, plan.times.size(), left, plan);
  return plan;
}

Result<LivePatterns::Plan> LivePatterns::plan_next(const Scene& scene, std::size_t shared) {
  if (coarse_ > 0 && store_.segment().shots.size() == 1) {
    const double left = pattern_room();
    if (left < kFiner * coarse_) return Plan{};
    const std::size_t last = store_.segment().states.size() - 1;  // nearest to what is not yet known
    const auto finer = key_quantiser(scene, last, left);
    if (!finer) return fail(finer.error());
    return sizes_.whole(*finer) <= 8 * left ? Plan{{last}, *finer, *finer, true} : Plan{};
  }
  SegmentDraft none;
  none.place(store_, scene);
  if (auto measured = stage_.measure(none.usable(scene), shared); !measured) return fail(measured.error());
  Plan plan;
  plan.key = coarse_ > 0;
  add_paying(least_errors(store_.segment(), stage_.errors()), 0, pattern_room(), plan);
  plan.first = plan.others;
  return plan;
}

void LivePatterns::add_paying(std::span<const double> least, std::size_t begin, double room, Plan& plan) {
  const bool windows = has_windows(settings_.delay);
  std::ptrdiff_t last = -since_pattern_;  // pattern, or cut
  bool cut = false;
  double sum = 0;
  std::optional<Bought> bought;
  std::size_t t = begin;
  for (; t < least.size(); ++t) {
    if (store_.segment().is_cut(t)) {
      last = static_cast<std::ptrdiff_t>(t);
      cut = true;
    }
    replacement_.add(least[t]);
    regret_.add(least[t]);
    sum += least[t];
    if (windows && (bought = paying(room, cut || plan.key, replacement_.recent()))) break;
  }
  if (!windows && t > begin) bought = paying(room, cut || plan.key, sum / static_cast<double>(t - begin));
  if (!bought) return;
  plan.others = bought->quantiser;
  if (!windows) {
    if (cut) {
      plan.times.push_back(static_cast<std::size_t>(last));
      return;
    }
    // The last picture is nearest to the pictures to come.
    const std::size_t count = std::min(bought->patterns, least.size() - begin);
    for (std::size_t k = 1; k <= count; ++k)
      plan.times.push_back(begin + (least.size() - begin) * k / count - 1);
    return;
  }
  // It took so long to pay. The first has as long before it, of what is not yet drawn, as behind it, and the
  // others follow as far apart.
  const auto interval =
      static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(t) - last));
  const std::size_t from = last < 0 ? 0 : static_cast<std::size_t>(last);
  const std::size_t end = least.size(), middle = interval < end ? from + interval / 2 : end - 1;
  const double later = sizes_.change(plan.others, interval) / 8;
  double spent = cut ? sizes_.whole(plan.others) / 8 : later;
  for (std::size_t p = std::clamp(middle, begin, end - 1); p < end && spent <= room; p += interval) {
    plan.times.push_back(p);
    spent += later;
  }
}

double LivePatterns::price(const PatternReplacement::Offers& offers,
                           const PatternReplacement::Timing& timing) {
  // A full buffer delays patterns; it must not make the price of later ones.
  const double least = kLeastShare * 8 * rate_->capacity() / settings_.buffer;
  const double bits = std::max(least, rate_->target() - motion_) / timing.per_second;
  const double now = replacement_.price_of(bits, offers, timing);
  const double seconds = static_cast<double>(timing.together) / timing.per_second;
  price_ = price_ ? *price_ * std::pow(now / *price_, 1 - std::exp(-seconds / kPriceFollows)) : now;
  return *price_;
}

double LivePatterns::fps() const {
  return static_cast<double>(stage_.pictures()) / store_.seconds();
}

std::optional<LivePatterns::Bought> LivePatterns::paying_at_rate(double room, bool whole, double error) {
  const auto pictures = static_cast<std::size_t>(std::max(1L, std::lround(settings_.delay * fps())));
  const bool two = 1LL * store_.format().width * store_.format().height <= kMostForTwo;
  const PatternReplacement::Timing timing{has_windows(settings_.delay) ? 1 : pictures, pictures, fps(), two};
  const double waiting = rate_->capacity() - rate_->room();
  // While nothing waits, the channel is idle.
  const double fits = 8 * (waiting < kIdle * rate_->capacity() ? 1 : kExpectedShare) * room;
  const PatternReplacement::Offers any{
      sizes_, 8 * std::min(kMostOfBuffer * rate_->capacity(), room + waiting), whole};
  const double bit = price(any, timing);
  auto best = replacement_.at_price(bit, any, timing);
  if (!best || !replacement_.pays(*best, error)) return std::nullopt;
  if (best->bits_now > fits) {
    // Room is saved up for it, unless a smaller one pays although it will soon be replaced.
    best = replacement_.at_price(bit, {sizes_, fits, whole}, timing);
    if (!best || best->cost >= error) return std::nullopt;
  }
  return Bought{best->quantiser, best->patterns};
}

std::optional<LivePatterns::Bought> LivePatterns::paying(double room, bool whole, double error) {
  if (rate_) return paying_at_rate(room, whole, error);
  const int quantiser = std::min(settings_.quantiser, kMaxQuantiser);
  const PatternReplacement::Offers offers{sizes_, 0, whole};
  const double bits = offers.bits_now(quantiser, replacement_.age());
  const double lambda = pattern_lambda(settings_.quantiser);
  const bool pays = has_windows(settings_.delay) ? regret_.pays(bits, kWindowPrice * lambda, kWindowPatience)
                                                 : regret_.pays(bits, lambda, 1);
  if (pays) return Bought{quantiser};
  if (!settings_.refines) return std::nullopt;
  const auto finer = replacement_.finer(lambda, sizes_, fps());
  return finer ? std::optional(Bought{*finer}) : std::nullopt;
}

Result<void> LivePatterns::code(const Scene& scene, const Plan& plan, SegmentDraft& draft) {
  std::vector<SequencePattern> coded;
  const auto since = static_cast<std::size_t>(since_pattern_);
  for (Picture& picture : draft.to_code(store_, scene, workers_)) {
    const std::size_t k = coded.size(), first = plan.start ? 1 : 0;
    const int quantiser = k <= first ? plan.first : plan.others;
    const bool coarse = k < first;
    auto next = coarse ? sequence_.code_start(picture, quantiser, *plan.start)
                       : sequence_.code(std::move(picture), quantiser);
    if (!next) return fail(next.error());
    coarse_ = coarse ? static_cast<double>(next->av1.size()) : 0;
    const double bits = 8.0 * static_cast<double>(next->av1.size());
    if (k == first && !coarse && (plan.key || store_.segment().shots.size() > 1))
      sizes_.set_whole(bits, quantiser);
    else if (!coarse)
      sizes_.learn(bits, quantiser, k > 0 ? plan.times[k] - plan.times[k - 1] : since + plan.times[k]);
    next->picture = k;
    if (coarse) draft.start = *next;
    coded.push_back(std::move(*next));
  }
  draft.alone = sequence_.alone();
  draft.take(store_, scene, std::move(coded));
  return {};
}

void LivePatterns::learn_errors(const Plan& plan) {
  const std::size_t pictures = store_.segment().states.size();
  if (plan.times.empty()) {  // its pictures have been counted
    since_pattern_ += static_cast<std::ptrdiff_t>(pictures);
    if (store_.segment().shots.size() > 1)
      since_pattern_ = static_cast<std::ptrdiff_t>(store_.segment().shots.back().pictures);
    return;
  }
  const std::size_t last = plan.times.back();
  const bool is_one = plan.times.size() == 1;
  double before = 0;
  std::size_t t = 0;
  for (const SegmentErrors::Run& run : stage_.errors().runs)
    for (std::size_t i = 0; i < run.pictures; ++i, ++t) {
      const double error = error_of(run.errors, store_.segment().states[t].blend);
      if (t <= last) before += error;
      if (t == last) {
        gain_ = (replacement_.recent() - error) * static_cast<double>(replacement_.age());
        replacement_.begin(error, is_one ? plan.first : plan.others);
        regret_.begin(error);
      }
      if (t > last) {
        replacement_.add(least_error(run.errors));
        regret_.add(least_error(run.errors));
      }
    }
  if (last > 1)
    replacement_.learn_between(before / static_cast<double>(last + 1), (last + 1) / plan.times.size());
  since_pattern_ = static_cast<std::ptrdiff_t>(pictures - last);
}

void LivePatterns::repeat(std::vector<TypedPayload>& packets) {
  const std::vector<TypedPayload> before = std::exchange(with_pattern_, {});
  const bool has_pattern =
      std::ranges::any_of(packets, [](const auto& p) { return p.first == PacketType::kPattern; });
  if (has_pattern) {
    if (settings_.alone && !store_.is_first() && !has_windows(settings_.delay)) with_pattern_ = packets;
    return;
  }
  const auto bytes = static_cast<double>(bytes_of(before));
  const bool pays = rate_ ? rate_->room() - bytes - static_cast<double>(bytes_of(packets)) >
                                kRepeatLeaves * rate_->capacity()
                          : kLossWeight * gain_ > pattern_lambda(settings_.quantiser) * 8 * bytes;
  if (pays) packets.insert(packets.begin(), before.begin(), before.end());
}

void LivePatterns::end_segment(std::vector<TypedPayload>& packets) {
  repeat(packets);
  const std::size_t bytes = bytes_of(packets);
  const double seconds = store_.seconds();
  sequence_.pass(seconds);
  age_ += seconds;
  if (!rate_) return;
  rate_->add(static_cast<double>(bytes), seconds);
  motion_ += kFollowMotion * (8 * (store_.motion_bytes() + kGroupHeadBytes) / seconds - motion_);
  const bool was_over = std::exchange(over_, rate_->room() < 0);
  if (over_ && !was_over)
    settings_.hooks.say(LogLevel::kWarning, "more waits to be sent than the buffer allows");
  if (was_over && !over_) settings_.hooks.say(LogLevel::kInfo, "what waits to be sent fits the buffer again");
}

Result<SegmentDraft> LivePatterns::make_segment(const Scene& scene, std::size_t other_bytes,
                                                const StateRefit& refit) {
  if (rate_) rate_->add(static_cast<double>(other_bytes), 0);
  const bool is_first = store_.is_first();
  if (is_first) {
    head_ = static_cast<double>(other_bytes);
    age_ = 0;
  }
  PatternStage::Making making;
  making.refits = refit && settings_.refits && !(is_first && store_.segment().states.size() == 1) ? 1 : 0;
  if (has_windows(settings_.delay) || 1LL * store_.format().width * store_.format().height > 352 * 288)
    making.draft_pictures = kDraftShared;
  const auto plan =
      is_first ? plan_first(scene) : plan_next(scene, making.refits > 0 ? making.draft_pictures : 1);
  if (!plan) return fail(plan.error());
  if (settings_.solves && has_windows(settings_.delay) && !plan->times.empty()) {
    making.trial.emplace();
    making.trial->quantiser = plan->others;
    making.trial->speed = kTrialSpeed;
    making.trial->reduced = true;
    making.solver.pull = kPull;
  }
  making.code = [&](SegmentDraft& sources) { return code(scene, *plan, sources); };
  auto draft = SegmentDraft::of_sources(store_, plan->times, next_slot_);
  if (draft) draft = stage_.make(scene, std::move(*draft), making, refit);
  if (!draft) return draft;
  next_slot_ = draft->slot(draft->coded.size(), static_cast<std::size_t>(store_.slots()));
  learn_errors(*plan);
  return draft;
}

}  // namespace fbs
