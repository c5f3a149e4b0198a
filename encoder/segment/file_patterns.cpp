#include "encoder/segment/file_patterns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "encoder/image/pyramid.h"
#include "encoder/patterns/first_pattern.h"
#include "encoder/patterns/pattern_size.h"
#include "encoder/patterns/pattern_trial.h"

namespace fbs {
namespace {

/// Largest size of a coarse first pattern, as a share of the wanted one: a larger one delays its
/// replacement.
constexpr double kCoarseShare = 1.0 / 3;

/// Limit for the patterns of a segment, bytes, of which several copies exist in the making.
constexpr double kSegmentBytes = 64e6;

// For choosing the number of patterns: pictures to code, and the interval of pictures to draw.
constexpr std::size_t kTrialPictures = 4, kLossEvery = 5;

/// A shot whose pictures differ from its first by no more than this, luma levels, is still. Compared at this
/// long side, pixels, where noise averages out and a talking mouth does not.
constexpr double kStillLevels = 4;
constexpr int kStillLongSide = 64;

/// Steps of the quantiser for twice the usual number of pictures per pattern: stills, such as slides, deserve
/// finer patterns. Their shared distortion falls with the square of the quantiser.
constexpr double kStepsPerSharing = 4.5;

constexpr int kMaxRateTrials = 4;  // recodings to meet a rate
constexpr double kRateTolerance = 0.02;

}  // namespace

FilePatterns::FilePatterns(PatternStage& stage, const FilePatternSettings& settings)
    : PatternPolicy(stage), settings_(settings), most_(store_.slots()), point_(settings.point) {
  coding_.speed = settings.effort.pattern_speed;
  coding_.threads = std::max(2, settings.threads);  // on one core, too: the stream is the same
  if (!settings.without_face) return;
  const double bytes = 1.5 * store_.format().width * store_.format().height;
  most_ = static_cast<std::int32_t>(
      std::clamp<double>(kSegmentBytes / bytes, store_.slots(), kMaxSequencePictures));
}

void FilePatterns::note_added(const Picture& picture) {
  const cv::Mat small =
      reduced(picture.y, reduction_factor(picture.width(), picture.height(), kStillLongSide));
  Shot& shot = store_.segment().shots.back();
  if (shot.pictures == 1) {
    shot.still = true;
    shot_first_ = small;
  } else if (cv::norm(small, shot_first_, cv::NORM_INF) > kStillLevels) {
    shot.still = false;
  }
}

bool FilePatterns::segment_ends(std::size_t /*next*/) const {
  // The motion of a whole segment may be sent before its first picture is shown.
  if (stage_.pictures() + kMaxGroupPictures > kMaxWaitingPictures) return true;
  if (settings_.count > 0) return false;
  if (std::cmp_greater_equal(store_.segment().shots.size(), store_.slots() / 2)) return true;
  const bool any_density = settings_.without_face && settings_.bitrate_kbps > 0;
  const double per_second = any_density ? settings_.point_at(100).per_second : point_.per_second;
  return store_.seconds() >= std::min(kSegmentSeconds, (most_ - 1) / per_second);
}

Result<SegmentDraft> FilePatterns::draft() const {
  std::vector<std::size_t> times = times_wanted();
  if (start_ && std::ranges::find(times, 1) == times.end()) times.insert(times.begin() + 1, 1);
  auto draft = SegmentDraft::of_sources(store_, std::move(times), 0);
  if (draft) draft->start = start_;
  return draft;
}

Result<double> FilePatterns::loss_between(const Scene& scene) {
  auto draft = this->draft();
  if (!draft) return fail(draft.error());
  draft->take_sources(store_, scene);
  return blend_loss(store_.segment(), draft->usable(scene), kLossEvery, workers_);
}

int FilePatterns::quantiser_at(bool reduced) const {
  if (settings_.quantiser) return *settings_.quantiser;
  const int halvings = reduced ? 1 : 0;
  const int usual =
      quantiser_of(point_, store_.format().width >> halvings, store_.format().height >> halvings);
  if (!settings_.without_face || settings_.count > 0) return usual;
  const double wanted =
      std::min(point_.per_second * store_.seconds(), static_cast<double>(store_.segment().states.size()));
  const double octaves = std::log2(wanted / static_cast<double>(times_wanted().size()));
  return std::max(0, usual - static_cast<int>(std::lround(kStepsPerSharing * std::max(0.0, octaves))));
}

SequenceSettings FilePatterns::trial_coding(bool reduced) const {
  SequenceSettings out = coding_;
  out.speed = kTrialSpeed;
  out.reduced = reduced;
  out.quantiser = quantiser_at(reduced);
  return out;
}

void FilePatterns::set_size(bool reduced) {
  coding_.reduced = reduced;
  coding_.quantiser = quantiser_at(reduced);
}

std::vector<std::size_t> FilePatterns::times_wanted() const {
  const std::size_t pictures = store_.segment().states.size();
  const double seconds = store_.seconds();
  const std::size_t wanted =
      settings_.count > 0 ? settings_.count
                          : pattern_count(store_.segment().shots, std::lround(point_.per_second * seconds));
  // All patterns of a group are kept at once.
  const std::size_t most =
      settings_.without_face
          ? std::min<std::size_t>(most_, store_.slots() / 2 * store_.segment().groups.size())
          : most_;
  return pattern_times(store_.segment().shots, std::min(std::clamp<std::size_t>(wanted, 1, most), pictures));
}

Result<std::vector<Picture>> FilePatterns::trial_pictures(std::span<const std::size_t> times) {
  const std::size_t count = std::min(kTrialPictures, times.size());
  std::vector<Picture> out;
  for (std::size_t k = 0; k < count; ++k) {
    auto picture = store_.segment().pictures.read(times[(times.size() - count) / 2 + k]);
    if (!picture) return fail(picture.error());
    out.push_back(*picture);
  }
  return out;
}

Result<bool> FilePatterns::reduced_size_pays(const Scene& scene) {
  const std::vector<std::size_t> times = times_wanted();
  if (times.size() < 2) return false;
  const auto loss = loss_between(scene);
  if (!loss) return fail(loss.error());
  const auto pictures = trial_pictures(times);
  if (!pictures) return fail(pictures.error());
  std::array<Result<PatternCost>, 2> costs;  // of full and reduced size
  workers_.run(2,
               [&](int k, int) { costs[k] = trial_cost(store_.format(), *pictures, trial_coding(k == 1)); });
  for (auto& cost : costs)
    if (!cost) return fail(cost.error());
  return fbs::reduced_size_pays(*loss, times.size(), store_.motion_bytes(), *costs[0], *costs[1]);
}

Result<void> FilePatterns::choose_size(const Scene& scene) {
  auto reduced = Result<bool>(large_enough_to_reduce(store_.format()));
  if (settings_.reduced)
    reduced = *settings_.reduced;
  else if (settings_.effort.tries_sizes)
    reduced = reduced_size_pays(scene);
  if (!reduced) return fail(reduced.error());
  set_size(*reduced);
  return {};
}

Result<double> FilePatterns::taken_by(const Setup& setup, const SegmentDraft& draft) const {
  SegmentStore::Coders coders = store_.coders();
  const auto packets = draft.packets(store_, setup, coders);
  if (!packets) return fail(packets.error());
  return static_cast<double>(bytes_of(*packets));
}

Result<int> FilePatterns::quality_for(const Scene& scene, double bytes) {
  int low = 0, high = 101;  // the highest that fits, and the lowest that does not
  while (high - low > 4) {
    const int middle = (low + high) / 2;
    point_ = settings_.point_at(middle);
    set_size(coding_.reduced);
    auto draft = this->draft();
    if (!draft) return fail(draft.error());
    if (auto coded = draft->code(store_, scene, trial_coding(coding_.reduced), workers_); !coded)
      return fail(coded.error());
    const auto taken = taken_by(scene.setup, *draft);
    if (!taken) return fail(taken.error());
    (*taken <= bytes ? low : high) = middle;
  }
  return low;
}

Result<void> FilePatterns::aim(const Scene& scene, double bytes) {
  point_ = settings_.point_at(50);
  for (int trial = 0; trial < 2; ++trial) {
    const bool before = coding_.reduced;
    if (auto sized = choose_size(scene); !sized) return sized;
    if (trial > 0 && coding_.reduced == before) break;
    const auto quality = quality_for(scene, bytes);
    if (!quality) return fail(quality.error());
    point_ = settings_.point_at(*quality);
    set_size(coding_.reduced);
  }
  return {};
}

Result<void> FilePatterns::begin_coarse(const Scene& scene, double bytes, double other_bytes) {
  const double in_time = 125 * settings_.bitrate_kbps * settings_.start - other_bytes - kPatternHeadBytes -
                         static_cast<double>(store_.segment().groups.front().payload.size());
  auto draft = this->draft();
  if (!draft) return fail(draft.error());
  if (auto coded = draft->code(store_, scene, trial_coding(coding_.reduced), workers_); !coded) return coded;
  const auto key = static_cast<double>(draft->coded.front().av1.size());
  if (key <= in_time) return {};
  auto coarse = code_start_pattern(store_.format(), draft->to_code(store_, scene, workers_).front(),
                                   {0, coding_.reduced, coding_.speed},
                                   static_cast<std::size_t>(std::clamp(in_time, 0.0, kCoarseShare * key)));
  if (!coarse) return fail(coarse.error());
  start_ = SequencePattern{0, std::move(coarse->av1), std::move(coarse->decoded)};
  return aim(scene, bytes);
}

Result<void> FilePatterns::meet(const Scene& scene, double bytes, SegmentDraft& draft) {
  // The nearest known quantisers with too many bytes and with few enough, and the logarithms of what they
  // took of those allowed.
  int over = -1, under = 64;
  double excess_over = 0, excess_under = 0;  // 0: unknown
  SegmentDraft best = draft;
  double nearest = 0;
  for (int trial = 0;; ++trial) {
    const auto taken = taken_by(scene.setup, draft);
    if (!taken) return fail(taken.error());
    const int quantiser = coding_.quantiser;
    const double excess = std::log(*taken / bytes), miss = std::abs(excess);
    (excess > 0 ? over : under) = quantiser;
    (excess > 0 ? excess_over : excess_under) = excess;
    if (trial == 0 || miss < nearest) {
      nearest = miss;
      best = draft;
    }
    if (trial == kMaxRateTrials || nearest < kRateTolerance || over + 1 >= under) break;
    const double per_step = excess_over > 0 && excess_under < 0
                                ? (excess_over - excess_under) / (under - over)
                                : std::log(kBytesPerStep);
    const int next =
        std::clamp(quantiser + static_cast<int>(std::lround(excess / per_step)), over + 1, under - 1);
    if (next == quantiser) break;
    coding_.quantiser = next;
    if (auto coded = draft.code(store_, scene, coding_, workers_); !coded) return coded;
  }
  draft = std::move(best);
  stage_.errors() = {};
  return stage_.choose(scene, draft, settings_.effort.pictures);
}

Result<SegmentDraft> FilePatterns::make_segment(const Scene& scene, std::size_t other_bytes,
                                                const StateRefit& refit) {
  const bool has_rate = settings_.bitrate_kbps > 0;
  const auto before = static_cast<double>(other_bytes);
  start_.reset();
  if (has_rate) left_bytes_ += 125 * settings_.bitrate_kbps * store_.seconds() - before;
  const double bytes = std::max(left_bytes_, 1.0);
  if (auto sized = has_rate ? aim(scene, bytes) : choose_size(scene); !sized) return fail(sized.error());
  if (has_rate && settings_.start > 0 && !stage_.begun() && store_.segment().groups.size() > 1)
    if (auto coarse = begin_coarse(scene, bytes, before); !coarse) return fail(coarse.error());
  auto draft = this->draft();
  if (!draft) return draft;
  // Few pictures do not justify a coarse pattern: its bytes are the startup of a scene with one pattern.
  if (store_.is_first() && draft->times.size() == 1 && !has_rate)
    coding_.quantiser = settings_.lone_quantiser;
  PatternStage::Making making;
  // Always at half size, since only the kind of errors matters.
  if (settings_.effort.solves) making.trial = trial_coding(true);
  // A lone pattern is close to the picture that the states were fitted to.
  making.refits = draft->times.size() > 1 ? settings_.effort.refits : 0;
  making.draft_pictures = settings_.effort.draft_pictures;
  making.pictures = settings_.effort.pictures;
  making.code = [&](SegmentDraft& sources) { return sources.code(store_, scene, coding_, workers_); };
  draft = stage_.make(scene, std::move(*draft), making, refit);
  if (draft && has_rate)
    if (auto met = meet(scene, bytes, *draft); !met) return fail(met.error());
  return draft;
}

}  // namespace fbs
