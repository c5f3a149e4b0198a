// The options of `fbs encode`.
#include <cstdint>

#include "cli/command_line/verb.h"
#include "cli/source/encoder_module.h"

namespace fbs::cli {
namespace {

constexpr const char* kEncodeExamples =
    "Examples:\n"
    "  fbs encode talk.mkv talk.fbs                    print size, bitrate and PSNR when done\n"
    "  fbs encode talk.mkv talk.fbs --quality 70       higher quality, larger file\n"
    "  fbs encode talk.mkv talk.fbs --bitrate 5        aim for a total of 5 kbit/s\n"
    "  fbs encode talk.mkv talk.fbs --sound codec2     a voice at 1 to 3 kbit/s; --no-sound: none\n"
    "  fbs encode talk.mkv talk.fbs --patterns 1       send one picture, then only motion\n"
    "  fbs encode talk.mkv talk.fbs --overlay see.mp4  also write a video of what was tracked\n"
    "  fbs encode talk.mkv talk.fbs --landmarks face.csv  also start from another tracker's landmarks\n"
    "  fbs encode camera:0 talk.fbs                    encode live, until Ctrl-C\n"
    "  fbs encode shots/frame_%05d.png talk.fbs --rate 30";

void add_encode_rate(CLI::App& verb, EncodeArguments& a) {
  verb.add_option("--quality", a.settings.quality, "From 0 (smallest file) to 100 (best pictures)")
      ->capture_default_str()
      ->check(CLI::Range(0, 100));
  verb.add_option("--bitrate", a.settings.bitrate, "Target total bitrate in kbit/s, instead of a quality")
      ->check(number_within(0.1, 10000))
      ->excludes("--quality");
  verb.add_option(
          "--start", a.settings.start,
          "Show the first picture after at most this many seconds at --bitrate; it is coarse if need be, "
          "and finer ones follow. 0: as fine as the rate allows (default: 0; with --live 1, or --buffer if "
          "that is less; 0 with --join or --resilience strong)")
      ->check(number_within(0, 60));
  verb.add_option("--patterns", a.settings.patterns,
                  "Number of patterns, in a long video of each two minutes or so; 1 sends one picture and "
                  "then only motion (default: chosen by the encoder)")
      ->check(CLI::Range(1, 64));
  verb.add_flag("--live,!--no-live", a.live,
                "Encode pictures as they come, without look-ahead; the default for a camera. Costs bits: a "
                "file is better encoded without");
  verb.add_option(
          "--delay", a.delay,
          "Delay of a live stream in seconds; its pictures are encoded together, so a longer delay takes "
          "fewer bits. Needs --live (default: 0.2)")
      ->check(number_within(0.01, 40));
  verb.add_option(
          "--buffer", a.buffer,
          "Most seconds that a picture may arrive late over a channel of the rate --bitrate; needs --live "
          "(default: 2)")
      ->check(number_within(0.1, 60));
  verb.add_option("--threads", a.settings.threads,
                  "Threads that encode; the stream is the same for any number (default: one for each core)")
      ->check(CLI::Range(1, 64));
  verb.add_option_function<std::string>(
          "--resilience",
          [&a](const std::string& to) {
            a.resilience = to == "packet"   ? Resilience::kPacket
                           : to == "strong" ? Resilience::kStrong
                                            : Resilience::kNone;
          },
          "Protection of a live stream against lost packets; packet: motion goes on without them, for "
          "links that send them again; strong: so do patterns, for one-way links; none: fewest bytes. "
          "Needs --live")
      ->check(CLI::IsMember({"none", "packet", "strong"}))
      ->type_name("none|packet|strong")
      ->default_str("none");
  verb.add_option(
          "--join", a.join,
          "Let a viewer join a live stream at any time within this many seconds; what begins a scene is "
          "repeated in parts. Needs --live (default: join only where a scene begins)")
      ->check(number_within(1, 3600));
  verb.add_option("--key-interval", a.settings.key_interval,
                  "Most seconds between the places where a viewer can join and damage ends (default: up to "
                  "40 with several patterns; none with --patterns 1; with --live 10, or 20 with --resilience "
                  "strong, or 40 with --join)")
      ->check(CLI::Range(0.2, 3600.0));
}

void add_sound(CLI::App& verb, EncodeArguments& a) {
  verb.add_option(
          "--sound", a.sound,
          "Codec of the sound: opus, or codec2 for speech at the lowest rates (default: opus, or codec2 if "
          "--bitrate is below 10 or --sound-bitrate below 6)")
      ->check(CLI::IsMember({"opus", "codec2"}))
      ->type_name("opus|codec2");
  verb.add_option(
          "--sound-bitrate", a.sound_bitrate,
          "Bitrate of the sound in kbit/s, part of --bitrate; 6 to 64 with opus, 1.2 to 3.2 with codec2 "
          "(default: chosen from --quality or --bitrate)")
      ->check(number_within(1.2, 64));
  verb.add_option("--track", a.track,
                  "Sound track of the source to encode, counted from 0 (default: its main one)")
      ->check(CLI::Range(0, 1000));
  verb.add_flag("--no-sound", a.no_sound, "Leave the sound out")
      ->excludes("--sound")
      ->excludes("--sound-bitrate")
      ->excludes("--track");
}

void add_experiments(CLI::App& verb, EncodeArguments& a) {
  verb.add_flag_callback("--reduced-patterns", [&a] { a.settings.reduced_patterns = true; })
      ->group(kHiddenGroup);
  verb.add_flag_callback("--full-size-patterns", [&a] { a.settings.reduced_patterns = false; })
      ->group(kHiddenGroup);
  // The gain of each part of the analysis: docs/paper.md.
  verb.add_flag("!--no-expression", a.settings.expression)->group(kHiddenGroup)->excludes("--track-only");
  verb.add_flag("!--no-contours-in-fit", a.settings.contours)->group(kHiddenGroup)->excludes("--track-only");
  verb.add_flag("!--no-descent", a.settings.descent)->group(kHiddenGroup);
  verb.add_flag("!--no-landmark-search", a.settings.landmark_search)->group(kHiddenGroup);
  verb.add_flag("!--still-surround", a.settings.surround)->group(kHiddenGroup);
  verb.add_option("--pattern-quantiser", a.settings.pattern_quantiser)
      ->check(CLI::Range(0, 63))
      ->group(kHiddenGroup);
  verb.add_option("--motion-bitrate", a.settings.motion_bitrate)
      ->check(number_within(0.05, 1000))
      ->group(kHiddenGroup);
}

}  // namespace

void add_encode(CLI::App& app, Run& run) {
  const auto [verb, a] = new_verb<EncodeArguments>(app, run, "encode", "Encode a video",
                                                   in_module(kEncoderModule, kEncodeSymbol));
  verb->add_option("INPUT", a.input,
                   "Video file, - (Y4M on standard input), camera:0, or images (frame_%05d.png or a folder)")
      ->required();
  verb->add_option("OUTPUT", a.output, "Stream to write (.fbs)")->required();
  add_encode_rate(*verb, a);
  add_sound(*verb, a);
  verb->add_option("--effort", a.settings.effort, "From 0 (fastest) to 9 (fewest bytes)")
      ->capture_default_str()
      ->check(CLI::Range(0, Effort::kMost));
  verb->add_option_function<std::string>(
          "--tune",
          [&settings = a.settings](const std::string& to) {
            settings.tune = to == "psnr" ? Tune::kPsnr : Tune::kEye;
          },
          "What bytes are spent for: mouth and eyes that look right, or the PSNR of the whole frame")
      ->check(CLI::IsMember({"eye", "psnr"}))
      ->type_name("eye|psnr")
      ->default_str("eye");
  verb->add_option(
      "--marks", a.marks,
      "JSON file with the positions of facial points in the first picture, {\"nose_tip\": [x, y], "
      "...} or {\"landmarks\": [68 points]}; detected automatically if not given");
  verb->add_option("--pattern", a.pattern,
                   "With --patterns 1: an image to send in the place of the first picture with a face, "
                   "painted over or drawn by hand (.png, .exr ...), of the video's size");
  verb->add_option(
      "--landmarks", a.landmarks,
      "CSV file with the 68 landmarks of each picture by any tracker (MediaPipe, OpenFace, dlib): "
      "one more start for the fit of each picture, used where it is best");
  verb->add_flag("--track-only", a.settings.track_only,
                 "The method of the paper alone: contours move the mesh, and nothing is fitted to decoded "
                 "pictures")
      ->excludes("--landmarks");
  verb->add_option("--face", a.settings.face, "Face to track; 0 is the largest")
      ->capture_default_str()
      ->check(CLI::Range(0, 99));
  verb->add_option("--overlay", a.overlay,
                   "Also write a video of the source with mesh and snakes drawn on it (.mp4, .mkv, .y4m)");
  verb->add_option("--frames", a.frames, "Encode the first N pictures only")
      ->check(CLI::Range(std::int64_t{1}, kMaxFrames))
      ->type_name("N");
  verb->add_option("--duration", a.duration,
                   "Encode the first SECONDS only; with --frames, whichever ends first")
      ->check(number_within(0.001, kMaxSeconds))
      ->type_name("SECONDS");
  verb->add_option("--rate", a.sequence_rate, "Pictures per second, for image sequences (default: 25)")
      ->check(number_within(0.01, 1000));
  add_rotate(*verb, a.rotate);
  verb->add_flag("--allow-no-face", a.settings.allow_no_face,
                 "Encode a video without a face, too, instead of failing");
  verb->add_flag("--quiet", a.quiet, "Print no progress bar and no summary, and measure no PSNR");
  add_experiments(*verb, a);
  verb->footer(kEncodeExamples);
}

}  // namespace fbs::cli
