#include "cli/encode_session.h"

#include <deque>

#include "cli/progress.h"

namespace fbs::cli {
namespace {

/// Duration as the encoder expects it: 0 where the pictures follow the frame rate to within two ticks.
std::uint32_t duration_of(std::int64_t pts, std::int64_t next_pts, std::uint32_t nominal) {
  const std::int64_t d = next_pts - pts, difference = d - nominal;
  const bool regular = difference >= -2 && difference <= 2;
  return regular || d <= 0 ? 0 : static_cast<std::uint32_t>(d);
}

}  // namespace

Result<Measure> encode_source(VideoSource& source, const EncoderSettings& settings, const TakeBytes& take,
                              const SeePicture& see, bool with_ssim, bool quiet) {
  auto encoder = Encoder::create(source.format(), settings);
  if (!encoder) return fail(encoder.error());
  StreamDecoder decoder;
  StreamMeter meter(decoder, with_ssim);
  std::deque<Picture> waiting;  // pushed, not yet decoded
  Progress progress("encoding", source.frame_count_estimate(), quiet);

  const auto pass_on = [&]() -> Result<void> {
    const auto bytes = encoder->take();
    if (bytes.empty()) return {};
    if (auto taken = take(bytes); !taken) return taken;
    decoder.feed(bytes);
    for (;;) {
      auto status = decoder.next();
      if (!status)
        return fail(ErrorCode::kInternal, "the encoded stream does not decode: " + status.error().text);
      if (*status != DecodeStatus::kPicture) return {};
      if (waiting.empty())
        return fail(ErrorCode::kInternal, "the encoded stream has more pictures than its source");
      if (auto compared = meter.compare(waiting.front()); !compared) return compared;
      waiting.pop_front();
    }
  };

  const std::uint32_t nominal = nominal_duration(source.format().frame_rate);
  std::int64_t done = 0;
  auto current = source.next();
  while (current && *current) {
    auto next = source.next();
    if (!next) return fail(next.error());
    const TimedPicture& now = **current;
    const std::uint32_t duration = *next ? duration_of(now.pts, (*next)->pts, nominal) : 0;
    if (auto pushed = encoder->push(now.picture, duration); !pushed) return fail(pushed.error());
    if (see)
      if (auto seen = see(now, encoder->analysis()); !seen) return fail(seen.error());
    waiting.push_back(std::move((*current)->picture));
    if (auto passed = pass_on(); !passed) return fail(passed.error());
    progress.update(++done);
    current = std::move(next);
  }
  if (!current) return fail(current.error());
  if (auto finished = encoder->finish(); !finished) return fail(finished.error());
  if (auto passed = pass_on(); !passed) return fail(passed.error());
  if (!waiting.empty())
    return fail(ErrorCode::kInternal, "the encoded stream has fewer pictures than its source");
  return meter.result();
}

}  // namespace fbs::cli
