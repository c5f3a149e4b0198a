// fbs play: shows a stream in a window.
#include <SDL.h>

#include <array>
#include <string>

#include "cli/files/output_check.h"
#include "cli/play/play_arguments.h"
#include "cli/play/player.h"
#include "cli/program/module.h"
#include "cli/program/outcome.h"

namespace fbs::cli {
namespace {

Result<void> check_files(const PlayArguments& a) {
  if (a.record == "-")
    return fail(ErrorCode::kInvalidArgument,
                "--record: pictures are saved in a file; use .y4m, .mp4 or .mkv");
  if (auto named = check_picture_name(a.record); !named) return named;
  const std::array inputs{NamedFile{"INPUT", a.input}, NamedFile{"--source", a.source}};
  const std::array outputs{NamedFile{"--record", a.record}};
  return check_distinct(inputs, outputs);
}

Result<Outcome> play(const PlayArguments& arguments) {
  if (auto checked = check_files(arguments); !checked) return fail(checked.error());
  Player player(arguments);
  // Decode one picture first, so that a bad stream gives an error and no window.
  if (auto opened = player.open(); !opened) return fail(opened.error());
  if (auto played = player.run(); !played) return fail(played.error());
  return Outcome::kComplete;
}

}  // namespace
}  // namespace fbs::cli

FBS_MODULE_EXPORT void fbs_run_play(const fbs::cli::PlayArguments& arguments,
                                    fbs::Result<fbs::cli::Outcome>& result) {
  result = fbs::cli::play(arguments);
}

FBS_MODULE_EXPORT const char* fbs_module_libraries() {
  SDL_version v{};
  SDL_GetVersion(&v);
  static const std::string text =
      "SDL " + std::to_string(v.major) + "." + std::to_string(v.minor) + "." + std::to_string(v.patch);
  return text.c_str();
}
