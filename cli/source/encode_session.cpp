#include "cli/source/encode_session.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <optional>
#include <utility>

#include "bitstream/syntax.h"
#include "cli/program/progress.h"
#include "encoder/segment/picture_spool.h"

namespace fbs::cli {
namespace {

/// Longest gap between two pictures, 1/90000 s: one hour. A longer one means that a clock was set, and is
/// shortened.
constexpr std::int64_t kMaxGap = 60 * std::int64_t{kMaxDuration};

/// Durations as the encoder expects them: 0 where the pictures follow the frame rate to within two ticks.
/// Over a long video the rounding of nominal durations adds up, and sound would drift: a drift beyond
/// kMaxRunaway is corrected at once.
class Durations {
 public:
  explicit Durations(std::uint32_t nominal) : nominal_(nominal) {}

  /// It may be more than kMaxDuration.
  std::uint32_t of(std::int64_t pts, std::int64_t next_pts) {
    const std::int64_t d = std::min(next_pts - pts, kMaxGap), difference = d - nominal_;
    if (d <= 0) return 0;
    const std::int64_t ahead = ahead_ - difference;  // of the pictures, after one of nominal duration
    const bool regular = std::abs(difference) <= 2 && std::abs(ahead) <= kMaxRunaway;
    if (regular) {
      ahead_ = ahead;
      return 0;
    }
    const std::int64_t right = std::max<std::int64_t>(1, d - ahead_);
    ahead_ += right - d;
    return static_cast<std::uint32_t>(right);
  }

 private:
  static constexpr std::int64_t kMaxRunaway = kTicksPerSecond / 200;  // 5 ms

  std::int64_t nominal_, ahead_ = 0;  // 1/90000 s
};

/// How long the coding of patterns takes that follows the last picture, as pictures: of a segment, of
/// kSegmentSeconds at most. Measured on two cores; live and with one pattern there is none.
double coding_after(const VideoSource& source, const EncoderSettings& settings) {
  const auto pictures = source.frame_count_estimate();
  if (!pictures || settings.live || settings.patterns == 1) return 0;
  const Rational& rate = source.format().frame_rate;
  const double segment = kSegmentSeconds * rate.num / rate.den;
  const double times = (0.6 + 0.18 * settings.effort) * (settings.bitrate > 0 ? 1.5 : 1);
  return times * std::min(static_cast<double>(*pictures), segment);
}

/// Measures the stream as it is encoded; for PSNR, it is decoded.
class ClosedLoop {
 public:
  /// @param nominal  duration of pictures that are pushed without one
  /// @param sound    null: none
  ClosedLoop(Encoder encoder, std::uint32_t nominal, SoundInterleaver* sound, const TakeBytes& take,
             Measured what)
      : encoder_(std::move(encoder)),
        nominal_(nominal),
        sound_(sound),
        take_(take),
        compares_(what != Measured::kRate),
        meter_(decoder_) {}

  /// A picture, in a slide show for instance, may last longer than a stream allows: it is repeated.
  Result<void> push(TimedPicture now, std::uint32_t duration, const SeePicture& see) {
    for (; duration > kMaxDuration; duration -= kMaxDuration, now.pts += kMaxDuration)
      if (auto pushed = push_one(now, kMaxDuration, see); !pushed) return pushed;
    return push_one(now, duration, see);
  }

  /// Passes on bytes that another thread codes, until there is another picture to read.
  Result<void> wait_for(const VideoSource& source) {
    constexpr std::chrono::milliseconds kPatience{5};
    while (encoder_.is_coding() && !source.is_ready(kPatience)) continue;
    return pass_on();
  }

  [[nodiscard]] int turn_to_upright() const { return encoder_.turn_to_upright(); }

  Result<Encoded> finish() {
    if (auto finished = encoder_.finish(); !finished) return fail(finished.error());
    if (auto passed = pass_on(); !passed) return fail(passed.error());
    if (!compares_) return Encoded{rate_, encoder_.report()};
    if (decoder_.pictures() < pushed_)
      return fail(ErrorCode::kInternal, "the encoded stream has fewer pictures than its source");
    return Encoded{meter_.result(), encoder_.report()};
  }

 private:
  Result<void> push_one(const TimedPicture& now, std::uint32_t duration, const SeePicture& see) {
    if (auto pushed = encoder_.push(now.picture, duration); !pushed) return pushed;
    if (see)
      if (auto seen = see(now, encoder_.analysis()); !seen) return seen;
    ++pushed_;
    if (compares_) {
      if (auto kept = waiting_.push(now.picture); !kept) return kept;
    } else {
      rate_.pictures = pushed_;
      rate_.seconds += static_cast<double>(duration == 0 ? nominal_ : duration) / kTicksPerSecond;
    }
    return pass_on();
  }

  Result<void> pass_on() {
    auto bytes = encoder_.take();
    if (bytes.empty()) return {};
    if (sound_ != nullptr) {
      auto added = sound_->add(bytes);
      if (!added) return fail(added.error());
      bytes = std::move(*added);
    }
    if (auto taken = take_(bytes); !taken) return taken;
    if (!compares_) {
      rate_.bytes.total += bytes.size();
      return {};
    }
    decoder_.feed(bytes);
    for (;;) {
      auto status = decoder_.next();
      if (!status)
        return fail(ErrorCode::kInternal, "the encoded stream does not decode: " + status.error().text);
      if (*status != DecodeStatus::kPicture) return {};
      if (decoder_.pictures() > pushed_)
        return fail(ErrorCode::kInternal, "the encoded stream has more pictures than its source");
      const auto source = waiting_.pop();
      if (!source) return fail(source.error());
      if (auto compared = meter_.compare(*source); !compared) return compared;
    }
  }

  Encoder encoder_;
  std::uint32_t nominal_;
  SoundInterleaver* sound_;
  const TakeBytes& take_;
  bool compares_;
  Measure rate_;  ///< unless it compares
  StreamDecoder decoder_;
  StreamMeter meter_;
  std::uint64_t pushed_ = 0;  ///< pictures
  PictureQueue waiting_;
};

}  // namespace

Result<Encoded> encode_source(VideoSource& source, const EncoderSettings& settings, const TakeBytes& take,
                              const SeePicture& see, Measured what, bool quiet, SoundInterleaver* sound) {
  auto encoder = Encoder::create(source.format(), settings);
  if (!encoder) return fail(encoder.error());
  const std::uint32_t nominal = nominal_duration(source.format().frame_rate);
  ClosedLoop loop(std::move(*encoder), nominal, sound, take, what);
  Progress progress("encoding", source.frame_count_estimate(), quiet);
  progress.expect_after(coding_after(source, settings));
  // A picture's duration is known when the next one arrives; to avoid the wait, a live picture gets the
  // duration of the previous one.
  const bool waits = !settings.live && !source.has_constant_rate();
  Durations durations(nominal);
  bool warned = quiet;
  std::int64_t done = 0, last_pts = -nominal;
  auto current = source.next();
  while (current && *current) {
    std::uint32_t duration =
        source.has_constant_rate() || waits ? 0 : durations.of(last_pts, (*current)->pts);
    std::optional<Result<std::optional<TimedPicture>>> next;
    if (waits) {
      next = source.next();
      if (!*next) return fail(next->error());
      duration = **next ? durations.of((*current)->pts, (**next)->pts) : 0;
    }
    last_pts = (*current)->pts;
    if (auto pushed = loop.push(std::move(**current), duration, see); !pushed) return fail(pushed.error());
    if (!warned && loop.turn_to_upright() != 0) {
      warned = true;
      progress.clear();
      print_turn_warning(loop.turn_to_upright());
    }
    progress.update(++done);
    if (auto waited = loop.wait_for(source); !waited) return fail(waited.error());
    current = next ? std::move(*next) : source.next();
  }
  if (!current) return fail(current.error());
  if (!progress.visible()) return loop.finish();
  auto encoded = std::async(std::launch::async, [&loop] { return loop.finish(); });
  while (encoded.wait_for(std::chrono::milliseconds(100)) != std::future_status::ready) progress.wait();
  return encoded.get();
}

void print_turn_warning(int degrees) {
  std::fprintf(stderr, "fbs: a face %s; --rotate %d puts it upright\n",
               degrees == 180 ? "is upside down" : "lies on its side", degrees);
}

std::string notes_of(const EncodingReport& report) {
  std::string out;
  if (report.cuts > 0) out = std::to_string(report.cuts) + (report.cuts == 1 ? " cut" : " cuts");
  const auto add = [&](const std::string& note) { out += (out.empty() ? "" : "; ") + note; };
  if (report.with_landmarks > 0)
    add("landmarks used in " + std::to_string(report.from_landmarks) + " of " +
        std::to_string(report.with_landmarks) + " pictures that have them");
  if (report.without_face > 0)
    add("no face followed in " + std::to_string(report.without_face) + " of " +
        std::to_string(report.pictures) + " pictures");
  return out;
}

}  // namespace fbs::cli
