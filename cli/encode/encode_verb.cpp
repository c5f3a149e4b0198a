// fbs encode: video to stream.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "cli/encode/overlay.h"
#include "cli/encode/sound_choice.h"
#include "cli/encode/sound_track.h"
#include "cli/files/atomic_file.h"
#include "cli/files/output_check.h"
#include "cli/program/module.h"
#include "cli/program/outcome.h"
#include "cli/source/encode_session.h"
#include "cli/source/encoder_module.h"
#include "cli/source/source_part.h"
#include "cli/source/until_stopped.h"
#include "cli/stream/stream_file.h"
#include "cli/video/video_modules.h"
#include "encoder/segment/pass_settings.h"

namespace fbs::cli {
namespace {

constexpr const char* kFinishingStream = "fbs: finishing the stream; a second signal ends at once";
constexpr double kLeastBitrate = 0.5;  // kbit/s of the pictures, beside sound

std::string rate_text(const char* name, double kbps) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%s%.2f", name, kbps);
  return text.data();
}

void print_summary(const std::string& output, const Encoded& encoded) {
  const Measure& m = encoded.measure;
  std::string sound;
  if (m.bytes.sound > 0) sound = rate_text(", sound ", m.rate(m.bytes.sound));
  std::fprintf(stderr, "%s: %llu pictures, %llu bytes, total %.2f kbit/s (motion %.2f%s)", output.c_str(),
               static_cast<unsigned long long>(m.pictures), static_cast<unsigned long long>(m.bytes.total),
               m.kbps(), m.rate(m.bytes.motion), sound.c_str());
  if (m.face.count > 0) std::fprintf(stderr, ", PSNR face %.2f dB", m.face.psnr());
  std::fprintf(stderr, "%s frame %.2f dB\n", m.face.count > 0 ? "," : ", PSNR", m.frame.psnr());
  if (const std::string notes = notes_of(encoded.report); !notes.empty())
    std::fprintf(stderr, "%s: %s\n", output.c_str(), notes.c_str());
}

/// An image in the video's format.
Result<Picture> read_image(const std::string& name, const VideoFormat& format) {
  const auto read = load_module_function<ReadImageFunction>(kImageModule, kReadImageSymbol);
  if (!read) return fail(read.error());
  Result<Picture> picture;
  (*read)(name, format, picture);
  return picture;
}

bool is_live(const EncodeArguments& arguments) {
  return arguments.live.value_or(arguments.input.starts_with("camera:"));
}

/// Refuses options that would do nothing.
Result<void> check_live(const EncodeArguments& a) {
  const auto refuse = [](const std::string& text) { return fail(ErrorCode::kInvalidArgument, text); };
  if (!is_live(a)) {
    const char* option = a.delay        ? "--delay"
                         : a.buffer     ? "--buffer"
                         : a.resilience ? "--resilience"
                         : a.join       ? "--join"
                                        : nullptr;
    if (option != nullptr) return refuse(std::string(option) + " needs --live");
  }
  if (a.settings.start.value_or(0) > 0 && a.settings.bitrate <= 0)
    return refuse("--start needs --bitrate, the rate that the first picture comes at");
  if (a.buffer && a.settings.bitrate <= 0) return refuse("--buffer needs --bitrate, the rate of the channel");
  return {};
}

Result<EncoderSettings> settings_of(const EncodeArguments& arguments, const VideoSource& source) {
  EncoderSettings settings = arguments.settings;
  if (is_live(arguments)) {
    LiveSettings& live = settings.live.emplace();
    live.delay = arguments.delay.value_or(live.delay);
    live.buffer = arguments.buffer.value_or(live.buffer);
    live.resilience = arguments.resilience.value_or(live.resilience);
    live.join = arguments.join.value_or(live.join);
  }
  if (!arguments.marks.empty()) {
    auto marks = read_marks(arguments.marks);
    if (!marks) return fail(about_file(arguments.marks, marks.error()));
    settings.marks = *marks;
  }
  if (!arguments.pattern.empty()) {
    auto pattern = read_image(arguments.pattern, source.format());
    if (!pattern) return fail(pattern.error());
    settings.first_pattern = std::move(*pattern);
  }
  if (!arguments.landmarks.empty()) {
    auto track = read_landmarks(arguments.landmarks, source.format().width, source.format().height);
    if (!track) return fail(about_file(arguments.landmarks, track.error()));
    settings.landmarks = std::make_shared<const LandmarkTrack>(std::move(*track));
  }
  settings.seconds = source.seconds_estimate().value_or(0);
  return settings;
}

/// The sound of the source, on its way into the stream.
struct Sound {
  std::unique_ptr<SoundTrack> track;
  std::unique_ptr<SoundInterleaver> interleaver;
};

/// Time from which no sound is needed, 1/90000 s: with --duration a second after it, for the last picture.
std::optional<std::int64_t> end_of_sound(const EncodeArguments& a) {
  if (!a.duration) return std::nullopt;
  constexpr double kMost = 1e9;  // s; above it the time would not fit into 64 bits
  return std::llround((std::min(*a.duration, kMost) + 1) * kTicksPerSecond);
}

/// @param settings  of the pictures: the sound's rate is subtracted from their bitrate
/// @return empty when there is none
Result<Sound> open_sound(const EncodeArguments& a, const StopSignal& stop, EncoderSettings& settings) {
  if (a.no_sound) return Sound{};
  const auto wanted = sound_settings(a, settings.live.has_value());
  if (!wanted) return fail(wanted.error());
  auto track = SoundTrack::open(a.input, *wanted, a.track, end_of_sound(a), stop);
  if (!track) return fail(track.error());
  if (!*track) {
    const char* option = a.sound           ? "--sound"
                         : a.sound_bitrate ? "--sound-bitrate"
                         : a.track         ? "--track"
                                           : nullptr;
    if (option == nullptr) return Sound{};
    return fail(ErrorCode::kInvalidArgument, std::string(option) + ": " + a.input + " has no sound");
  }
  if (settings.bitrate > 0) {
    // A voice has pauses, in which Opus takes next to nothing. The rate of a live voice is unknown.
    const Result<double> taken = settings.live ? sound_kbps(*wanted) : (*track)->code_all();
    if (!taken) return fail(taken.error());
    settings.bitrate -= *taken;
    if (settings.bitrate < kLeastBitrate)
      return fail(ErrorCode::kInvalidArgument,
                  "--bitrate leaves nothing to the pictures; --sound codec2 takes less, --no-sound nothing");
  }
  auto interleaver = std::make_unique<SoundInterleaver>(
      (*track)->setup(), [&track = **track](std::int64_t time) { return track.before(time); });
  return Sound{std::move(*track), std::move(interleaver)};
}

Error with_advice(Error error) {
  if (error.code == ErrorCode::kNoFace) error.text += "; --allow-no-face encodes it all the same";
  return error;
}

/// @param settings  their bitrate is the total, with the sound
void print_warnings(const EncodeArguments& arguments, const EncoderSettings& settings,
                    const SourcePart& source, const Measure& measure) {
  print_source_warning(arguments.input, source, measure.pictures, "encoded", arguments.quiet);
  if (misses_bitrate(settings, measure.kbps(), measure.seconds))
    std::fprintf(stderr, "fbs: %s: target %.2f kbit/s not reachable, got %.2f\n", arguments.output.c_str(),
                 settings.bitrate, measure.kbps());
}

Result<void> check_files(const EncodeArguments& a) {
  if (!a.landmarks.empty() && a.input.starts_with("camera:"))
    return fail(ErrorCode::kInvalidArgument, "--landmarks: pictures of a camera have no numbers");
  if (auto live = check_live(a); !live) return live;
  if (auto named = check_stream_name(a.output); !named) return named;
  if (!a.pattern.empty() && a.settings.patterns != 1)
    return fail(ErrorCode::kInvalidArgument,
                "--pattern needs --patterns 1: with several, patterns are made of the video's pictures");
  const std::array inputs{NamedFile{"INPUT", a.input}, NamedFile{"--marks", a.marks},
                          NamedFile{"--landmarks", a.landmarks}, NamedFile{"--pattern", a.pattern}};
  const std::array outputs{NamedFile{"OUTPUT", a.output}, NamedFile{"--overlay", a.overlay}};
  return check_distinct(inputs, outputs);
}

/// Pictures come and go all the time. That the system takes their memory back each time costs 1 to 3 % of the
/// time; kept, there are 3 MB more. No more heaps than threads that work at once: each open scene has threads
/// of its own, whose heaps would hold as much again.
void keep_freed_memory([[maybe_unused]] int threads) {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // NOLINT(concurrency-mt-unsafe): ahead of all other threads
  mallopt(M_TRIM_THRESHOLD, 64 << 20);  // NOLINT(concurrency-mt-unsafe)
  mallopt(M_ARENA_MAX, threads);        // NOLINT(concurrency-mt-unsafe)
#endif
}

Result<Outcome> encode(const EncodeArguments& arguments, const StopSignal& stop) {
  if (auto checked = check_files(arguments); !checked) return fail(checked.error());
  auto opened = open_source_part(arguments.input, {arguments.frames, arguments.duration},
                                 arguments.sequence_rate, arguments.rotate, stop);
  if (!opened) return fail(opened.error());
  SourcePart& source = *opened;
  auto settings = settings_of(arguments, source);
  if (!settings) return fail(settings.error());
  const auto sound = open_sound(arguments, stop, *settings);
  if (!sound) return fail(sound.error());
  auto file = AtomicFile::create(arguments.output);
  if (!file) return fail(file.error());
  if (file->replaced_leftover()) print_replaced_leftover(arguments.output);
  std::optional<Overlay> overlay;
  SeePicture see;
  if (!arguments.overlay.empty()) {
    auto created = Overlay::create(arguments.overlay, source.format());
    if (!created) return fail(created.error());
    overlay.emplace(std::move(*created));
    see = [&](const TimedPicture& p, const PictureAnalysis& a) {
      return overlay->write(p.picture, p.pts, a);
    };
  }
  const auto encoded = encode_source(
      source, *settings,
      [&](std::span<const std::uint8_t> bytes) {
        return file->write(bytes).and_then([&] { return file->flush(); });
      },
      see, arguments.quiet ? Measured::kRate : Measured::kPsnr, arguments.quiet, sound->interleaver.get());
  if (!encoded) return fail(with_advice(about_input(encoded.error(), arguments.input)));
  if (overlay)
    if (auto finished = overlay->finish(); !finished) return fail(finished.error());
  if (auto committed = file->commit(); !committed) return fail(committed.error());
  settings->bitrate = arguments.settings.bitrate;  // as what was measured, with the sound
  print_warnings(arguments, *settings, source, encoded->measure);
  if (!arguments.quiet) print_summary(arguments.output, *encoded);
  return source.is_whole() ? Outcome::kComplete : Outcome::kPartial;
}

}  // namespace
}  // namespace fbs::cli

FBS_MODULE_EXPORT void fbs_run_encode(const fbs::cli::EncodeArguments& arguments,
                                      fbs::Result<fbs::cli::Outcome>& result) {
  fbs::cli::keep_freed_memory(fbs::thread_count(arguments.settings));
  result =
      fbs::cli::until_stopped(arguments.quiet, fbs::cli::kFinishingStream, "nothing written",
                              [&](const fbs::StopSignal& stop) { return fbs::cli::encode(arguments, stop); });
}
