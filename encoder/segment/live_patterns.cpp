#include "encoder/segment/live_patterns.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "encoder/blend/mode_choice.h"
#include "encoder/patterns/downscale.h"
#include "encoder/patterns/first_pattern.h"
#include "encoder/plan/pattern_point.h"

namespace fbs {
namespace {

/// Assumed size of a later pattern relative to the first, until one has been coded.
constexpr double kLaterShare = 0.35;

/// How fast the expected size of a pattern follows coded ones.
constexpr double kLearn = 0.5;

/// How much finer a scene's first pattern is: all others are predicted from it, and at first it is alone.
constexpr int kKeyBoost = 12;

/// Trials to find the size of the first pattern.
constexpr int kMaxKeyTrials = 3;

constexpr int kMaxQuantiser = 63;

/// Samples per picture for which a core has time at full effort.
constexpr int kCif = 352 * 288;

/// libaom's speeds when a core has time left and when not: at CIF 6 takes 12 % more of the whole rate than 3.
struct Speeds {
  int unhurried, hasty;
};
Speeds speeds_at(const VideoFormat& size) {
  const int samples = size.width * size.height;
  if (samples <= kCif) return {3, 6};
  return {samples <= 640 * 480 ? 5 : 6, kRealTimeSpeed};
}

/// Patterns for which there is time: two a second at CIF, and two at once.
constexpr double kUnhurriedSamplesPerSecond = 2 * kCif, kUnhurriedAtOnce = 2;
double unhurried_per_second(const VideoFormat& size) {
  return kUnhurriedSamplesPerSecond / (1.0 * size.width * size.height);
}

/// How many pictures share their errors at most where states may be fitted anew: more where time is short.
/// That takes 4 % of it, and 2 to 3 % more of the rate.
std::size_t shared_before(const StateRefit& refit, const VideoFormat& format) {
  return refit && format.width * format.height > kCif ? 3 : 1;
}

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

}  // namespace

LivePatterns::LivePatterns(const VideoFormat& format, const LivePatternSettings& settings,
                           const CodedState& rest)
    : settings_(settings),
      workers_(settings.threads),
      store_(format, rest, settings.groups_per_key),
      alone_(settings.alone) {
  if (settings.bitrate_kbps > 0) rate_.emplace(settings.bitrate_kbps, settings.buffer);
}

void LivePatterns::begin_scene(const CodedState& rest) {
  store_.begin_scene(rest);
  codec_.reset();
  alone_ = settings_.alone;
  regret_ = {};
  modes_ = {};
  next_slot_ = 0;
}

void LivePatterns::lose_patterns() {
  if (alone_ || store_.is_first()) return;
  alone_ = true;
  codec_.reset();  // the next one follows the first pattern
}

std::size_t LivePatterns::pattern_time() const {
  if (store_.is_first()) return 0;
  if (store_.segment().shots.size() > 1)
    return store_.segment().states.size() - store_.segment().shots.back().pictures;
  return store_.segment().states.size() - 1;
}

SegmentPatterns LivePatterns::usable(const Scene& scene) const {
  AvailablePatterns all(scene.patterns.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return {{*scene.geometry, scene.setup.mouth, scene.patterns},
          std::vector(store_.segment().groups.size(), all)};
}

double LivePatterns::Size::at(int other_quantiser) const {
  return bits * std::pow(kBytesPerStep, quantiser - other_quantiser);
}

std::optional<int> LivePatterns::affordable(const Size& size, int from) const {
  if (!rate_) return from;
  for (int q = from; q <= kMaxQuantiser; ++q)
    if (size.at(q) <= 8 * rate_->room()) return q;
  return std::nullopt;
}

Result<int> LivePatterns::key_quantiser() {
  const double price = rate_ ? rate_->price() : 1;
  const int wanted = std::max(0, quantiser_at_price(settings_.quantiser, price) - kKeyBoost);
  if (!rate_) return wanted;
  if (key_.bits > 0) return affordable(key_, wanted).value_or(kMaxQuantiser);
  auto picture = store_.segment().pictures.read(0);
  if (!picture) return fail(picture.error());
  if (settings_.reduced) *picture = downscaled(*picture);
  FirstPattern trial(coded_format(), *picture, kTrialSpeed);
  int quantiser = wanted;
  for (int i = 0; i < kMaxKeyTrials; ++i) {
    const auto bytes = trial.bytes(quantiser);
    if (!bytes) return fail(bytes.error());
    key_ = {8.0 * static_cast<double>(*bytes), quantiser};
    const int next = affordable(key_, wanted).value_or(kMaxQuantiser);
    if (next == quantiser) break;
    quantiser = next;
  }
  return quantiser;
}

Result<std::optional<int>> LivePatterns::later_quantiser(const Scene& scene, std::size_t shared) {
  if (auto measured = measure(scene, shared); !measured) return fail(measured.error());
  for (const SegmentErrors::Run& run : errors_.runs)
    for (std::size_t i = 0; i < run.pictures; ++i) regret_.add(least_error(run.errors));
  const double price = rate_ ? rate_->price() : 1;
  const Size& size = store_.segment().shots.size() > 1 ? key_ : later_;
  const auto quantiser = affordable(size, quantiser_at_price(settings_.quantiser, price));
  if (!quantiser || !regret_.pays(size.at(*quantiser), price * pattern_lambda(settings_.quantiser)))
    return std::nullopt;
  return quantiser;
}

VideoFormat LivePatterns::coded_format() const {
  VideoFormat format = store_.format();
  if (settings_.reduced) {
    format.width = reduced_size(format.width);
    format.height = reduced_size(format.height);
  }
  return format;
}

int LivePatterns::speed() const {
  const Speeds speeds = speeds_at(coded_format());
  return coded_lately_ < kUnhurriedAtOnce ? speeds.unhurried : speeds.hasty;
}

Result<void> LivePatterns::open(int quantiser, int speed) {
  auto av1 = Av1Encoder::create(coded_format(), {quantiser, speed});
  if (!av1) return fail(av1.error());
  auto decoder = PatternDecoder::create(store_.format().width, store_.format().height);
  if (!decoder) return fail(decoder.error());
  codec_.emplace(Codec{std::move(*av1), std::move(*decoder)});
  return {};
}

Result<LivePatterns::Coded> LivePatterns::code(const Picture& picture) {
  auto frames = codec_->encoder.encode(picture, alone_);
  if (!frames) return fail(frames.error());
  if (frames->size() != 1) return fail(ErrorCode::kInternal, "libaom holds a pattern back");
  auto decoded = codec_->decoder.decode(frames->front());
  if (!decoded) return fail(decoded.error());
  return Coded{std::move(frames->front()), std::move(*decoded)};
}

Result<LivePatterns::Sent> LivePatterns::code(const Scene& scene, std::size_t time, int quantiser) {
  auto picture = store_.segment().pictures.read(time);
  if (!picture) return fail(picture.error());
  store_.reduce_contrast(scene, time, *picture);
  if (settings_.reduced) *picture = downscaled(*picture);
  const int now = speed();
  const bool is_first = store_.is_first();
  if (is_first) first_ = {*picture, quantiser, std::min(now, speeds_at(coded_format()).unhurried)};
  if (!codec_) {
    if (auto opened = open(first_.quantiser, first_.speed); !opened) return fail(opened.error());
    if (!is_first)
      if (auto again = code(first_.picture); !again) return fail(again.error());
  }
  if (!is_first)
    if (auto set = codec_->encoder.set(quantiser, now); !set) return fail(set.error());
  auto coded = code(*picture);
  if (!coded) return fail(coded.error());
  learn(coded->av1.size(), quantiser);
  ++coded_lately_;
  const std::size_t slot =
      std::exchange(next_slot_, (next_slot_ + 1) % static_cast<std::size_t>(store_.slots()));
  return Sent{time, slot, std::move(coded->av1), std::move(coded->decoded)};
}

void LivePatterns::learn(std::size_t bytes, int quantiser) {
  const double bits = 8.0 * static_cast<double>(bytes);
  if (store_.is_first() || store_.segment().shots.size() > 1) {
    key_ = {bits, quantiser};
    if (later_.bits == 0) later_ = {kLaterShare * key_.at(settings_.quantiser), settings_.quantiser};
  } else {
    later_ = {later_.at(quantiser) + kLearn * (bits - later_.at(quantiser)), quantiser};
  }
}

void LivePatterns::place(Scene& scene, const Sent& sent) {
  errors_ = {};
  const State& seen = store_.seen_state(scene, sent.time);
  Pattern pattern = make_coded_pattern(sent.decoded, seen, scene.geometry, scene.setup);
  pattern.slot = static_cast<std::int32_t>(sent.slot);
  scene.patterns.store(std::move(pattern));
}

Result<void> LivePatterns::measure(const Scene& scene, std::size_t shared) {
  if (!errors_.runs.empty()) return {};
  auto errors = mode_errors(store_.segment(), usable(scene), shared, workers_);
  if (!errors) return fail(errors.error());
  errors_ = std::move(*errors);
  return {};
}

Result<void> LivePatterns::choose(const Scene& scene, std::size_t shared) {
  if (auto measured = measure(scene, shared); !measured) return measured;
  store_.set_modes(errors_.cheapest_modes(settings_.lambda, modes_));
  return {};
}

Result<std::vector<TypedPayload>> LivePatterns::packets(const Setup& setup, const std::optional<Sent>& sent) {
  // A pattern comes between the motion and the modes of its picture, but the scene's first, which carries its
  // state and to which motion is relative, before both.
  const bool apart = sent && !store_.is_first();
  SegmentStore::Coders& coders = store_.coders();
  std::vector<TypedPayload> out;
  const auto add_pattern = [&]() -> Result<void> {
    if (!sent) return {};
    PatternSyntax pattern = store_.pattern_syntax(sent->slot, sent->time, sent->av1);
    pattern.alone = alone_ && !store_.is_first();
    auto payload = coders.patterns.encode(std::span(&pattern, 1), setup,
                                          store_.number_of(store_.segment().states.size()));
    if (!payload) return fail(payload.error());
    out.emplace_back(PacketType::kPattern, std::move(*payload));
    return {};
  };
  if (apart)
    for (Segment::Group& group : store_.segment().groups)
      out.emplace_back(PacketType::kMotion, std::move(group.payload));
  if (auto added = add_pattern(); !added) return fail(added.error());
  std::size_t first = 0;
  for (const Segment::Group& group : store_.segment().groups) {
    const BlendGroup blend = store_.blend_group(coders.blends, first, group.pictures);
    auto payload = apart ? coders.blends.encode(blend) : coders.blends.encode_in_unit(blend);
    if (!payload) return fail(payload.error());
    if (apart)
      out.emplace_back(PacketType::kBlend, std::move(*payload));
    else
      out.emplace_back(PacketType::kUnit, unit_payload(group.payload, *payload));
    first += group.pictures;
  }
  return out;
}

Result<std::optional<LivePatterns::Sent>> LivePatterns::make(Scene& scene, std::optional<int> quantiser,
                                                             const StateRefit& refit) {
  std::optional<Sent> sent;
  const std::size_t time = pattern_time();
  if (quantiser) {
    auto coded = code(scene, time, *quantiser);
    if (!coded) return fail(coded.error());
    sent.emplace(std::move(*coded));
    place(scene, *sent);
  }
  if (auto chosen = choose(scene, shared_before(refit, store_.format())); !chosen)
    return fail(chosen.error());
  if (refit) {
    if (auto done = refit(store_.segment(), usable(scene), workers_); !done) return fail(done.error());
    errors_ = {};
    if (sent) place(scene, *sent);
    if (auto chosen = choose(scene, 1); !chosen) return fail(chosen.error());
  }
  if (sent) regret_.begin(error_of(errors_.runs[time].errors, store_.segment().states[time].blend));
  return sent;
}

Result<std::vector<TypedPayload>> LivePatterns::end_segment(Scene& scene, std::size_t other_bytes,
                                                            const StateRefit& refit) {
  if (store_.segment().states.empty()) return std::vector<TypedPayload>{};
  const StateRefit used = settings_.refits && !store_.is_first() ? refit : StateRefit{};
  Result<std::optional<int>> quantiser = store_.is_first()
                                             ? Result<std::optional<int>>(key_quantiser())
                                             : later_quantiser(scene, shared_before(used, store_.format()));
  if (!quantiser) return fail(quantiser.error());
  const auto sent = make(scene, *quantiser, used);
  if (!sent) return fail(sent.error());
  auto out = packets(scene.setup, *sent);
  if (!out) return out;
  const double seconds = store_.seconds();
  coded_lately_ = std::max(0.0, coded_lately_ - unhurried_per_second(coded_format()) * seconds);
  if (rate_) rate_->add(static_cast<double>(other_bytes + bytes_of(*out)), seconds);
  modes_ = store_.segment().states.back().blend;
  store_.end_segment();
  errors_ = {};
  return out;
}

}  // namespace fbs
