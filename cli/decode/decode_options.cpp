// The options of `fbs decode`.

#include "cli/command_line/verb.h"
#include "cli/decode/decode_arguments.h"
#include "common/picture.h"

namespace fbs::cli {
namespace {

constexpr const char* kDecodeExamples =
    "Examples:\n"
    "  fbs decode talk.fbs talk.y4m                    or .mp4, .mkv, frame_%05d.png\n"
    "  fbs decode talk.fbs - | mpv -                   pipe into a player\n"
    "  fbs decode talk.fbs part.mkv --from 90          begin at 1:30\n"
    "  fbs decode talk.fbs talk.mp4 --sound talk.mkv   put the sound of the source beside the pictures\n"
    "  fbs decode talk.fbs talk.wav                    the sound alone\n"
    "  fbs decode talk.fbs --md5                       compare decoders picture by picture\n"
    "  fbs decode talk.fbs talk.png --thumbnail 256    the picture that file managers show\n"
    "  fbs decode broken.fbs rest.y4m --keep-going     save what is left of a damaged stream";

}  // namespace

void add_decode(CLI::App& app, Run& run) {
  const auto [verb, a] = new_verb<DecodeArguments>(app, run, "decode", "Decode a stream", run_decode);
  verb->add_option("INPUT", a.input, "Stream to decode, or - for standard input")->required();
  verb->add_option(
      "OUTPUT", a.output,
      ".y4m, - (Y4M on standard output), .mp4, .mkv, frame_%05d.png, null: to discard, or .wav for the "
      "sound alone");
  verb->add_flag("--md5", a.md5,
                 "Print the MD5 of the planes Y, U, V of each picture, a line each; OUTPUT may be left out");
  verb->add_option("--sound", a.sound,
                   "Copy the sound of this file into the output (.mp4, .mkv), instead of the stream's own");
  verb->add_flag("--no-sound", a.no_sound, "Leave the sound out (.mp4, .mkv)")->excludes("--sound");
  verb->add_flag(
      "--vfr", a.vfr,
      "Y4M: write each picture once; without it pictures are repeated or dropped where the frame rate "
      "varies, to keep the speed");
  add_from(*verb, a.from);
  verb->add_option(
          "--thumbnail", a.thumbnail,
          "Write one picture alone, a PNG whose longer side is at most this: the first with open eyes "
          "that shows the face from the front, if there is one near the beginning")
      ->check(CLI::Range(1, kMaxPictureSize))
      ->type_name("PIXELS")
      ->excludes("--md5", "--sound", "--no-sound", "--vfr");
  verb->add_option("--threads", a.threads,
                   "Threads that draw pictures side by side (default: one for each core, up to 16)")
      ->check(CLI::Range(1, 64));
  verb->add_flag(
      "--keep-going", a.keep_going,
      "Write all that can be decoded of a damaged or cut stream, and repeat pictures in the place of "
      "lost ones; exit code 0: nothing lost; 3: less than a tenth of the pictures, or only the end "
      "is missing; 4: more");
  verb->add_flag("--quiet", a.quiet, "Print no progress bar");
  verb->footer(kDecodeExamples);
}

}  // namespace fbs::cli
