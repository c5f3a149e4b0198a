#include "cli/stream/loss_report.h"

#include <cstdio>

namespace fbs::cli {
namespace {

constexpr std::uint64_t kMuch = 10;  // one picture in so many lost

bool is_final(ErrorCode code) {
  return code == ErrorCode::kIo || code == ErrorCode::kNotFbs || code == ErrorCode::kInternal ||
         code == ErrorCode::kInvalidArgument;
}

unsigned long long number(std::uint64_t n) {
  return n;
}

}  // namespace

Result<DecodeStatus> LossReport::next(StreamFile& file) {
  for (;;) {
    auto status = file.next();
    if (status && *status == DecodeStatus::kPicture) {
      interpolated_ += file.decoder().quality() == PictureQuality::kInterpolated ? 1 : 0;
      lack_patterns_ += file.decoder().quality() == PictureQuality::kPatternMissing ? 1 : 0;
    }
    if (status || is_final(status.error().code)) return status;
    ++places_;
    if (progress_ == nullptr || places_ > kMaxLines) continue;
    progress_->finish();
    std::fprintf(stderr, "fbs: %s; continuing\n", status.error().text.c_str());
    if (places_ == kMaxLines) std::fprintf(stderr, "fbs: more damage is counted, not listed\n");
  }
}

Outcome LossReport::finish(StreamFile& file) const {
  const StreamDecoder& decoder = file.decoder();
  const bool ended = decoder.announced_pictures().has_value();
  const std::uint64_t missing = decoder.missing_pictures(), held = decoder.held_pictures();
  const std::uint64_t all = decoder.pictures() - held + missing;
  if (places_ > 0)
    std::fprintf(stderr,
                 "fbs: %s: damaged places: %d; pictures lost: %llu of %llu, held: %llu, interpolated: %llu, "
                 "without a lost pattern: %llu\n",
                 file.name().c_str(), places_, number(missing), number(all), number(held),
                 number(interpolated_), number(lack_patterns_));
  if (!ended) std::fprintf(stderr, "fbs: %s: %s\n", file.name().c_str(), missing_end_text(decoder).c_str());
  if (missing > 0 && missing * kMuch >= all) return Outcome::kMuchLost;
  return places_ > 0 || missing > 0 || !ended ? Outcome::kLittleLost : Outcome::kComplete;
}

std::string missing_end_text(const StreamDecoder& decoder) {
  const std::uint64_t pictures = decoder.position().pictures + (decoder.pictures() > 0 ? 1 : 0);
  return "the end packet is missing: the stream was cut after " + std::to_string(pictures) +
         (pictures == 1 ? " picture" : " pictures") + ", or has not ended";
}

}  // namespace fbs::cli
