// The options of `fbs retarget`.

#include "cli/command_line/verb.h"
#include "cli/source/encoder_module.h"

namespace fbs::cli {
namespace {

constexpr const char* kRetargetExamples =
    "Examples:\n"
    "  fbs retarget --motion anna.fbs --face bert.fbs out.fbs       Bert does what Anna does\n"
    "  fbs retarget --motion anna.fbs --face photo.jpg out.fbs      so does a photograph\n"
    "  fbs retarget --motion anna.fbs --face anna.fbs --wire-frame fine.gltf out.fbs";

}  // namespace

void add_retarget(CLI::App& app, Run& run) {
  const auto [verb, a] = new_verb<RetargetArguments>(
      app, run, "retarget", "Give a face the motion of another", in_module(kEncoderModule, kRetargetSymbol));
  verb->add_option("--motion", a.motion, "Stream whose pose and expression are used; - for standard input")
      ->required()
      ->type_name("STREAM");
  verb->add_option("--face", a.face, "Whose face: a stream, or a picture of somebody")
      ->required()
      ->type_name("STREAM|PICTURE");
  verb->add_option("--wire-frame", a.wire_frame, "Draw the face on this wire-frame (.gltf, .glb)")
      ->type_name("MODEL");
  verb->add_option("OUTPUT", a.output, "Stream to write (.fbs)")->required();
  verb->add_option("--quality", a.quality,
                   "Quality of the pattern, from 0 to 100, where --face is a picture (default: 70)")
      ->check(CLI::Range(0, 100));
  verb->add_flag("--no-sound", a.no_sound, "Leave out the sound, which is that of --motion");
  verb->add_flag("--quiet", a.quiet, "Print no summary");
  verb->footer(kRetargetExamples);
}

}  // namespace fbs::cli
