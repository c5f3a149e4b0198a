// fbs play: shows a stream in a window.
#include <cstdio>
#include <cstdlib>
#include <opencv2/core.hpp>

#include "cli/module.h"
#include "cli/outcome.h"
#include "cli/play/play_arguments.h"
#include "cli/play/player.h"
#include "cli/stream/loss_report.h"
#include "cli/stream/stream_file.h"

namespace fbs::cli {
namespace {

bool has_display() {
  const auto set = [](const char* name) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no thread changes the environment
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY") || set("QT_QPA_PLATFORM");
}

/// At the picture to begin with.
Result<StreamFile> open(const PlayArguments& arguments) {
  auto file = StreamFile::open(arguments.input);
  if (file && arguments.from > 0)
    if (auto sought = file->seek(ticks(arguments.from)); !sought) return fail(sought.error());
  return file;
}

Result<Outcome> play(const PlayArguments& arguments) {
  // Decode one picture first, so that a bad stream gives an error and no window.
  auto probe = open(arguments);
  if (!probe) return fail(probe.error());
  if (auto first = LossReport().next(*probe); !first) return fail(first.error());
  // highgui aborts the program when there is no display.
  if (!has_display()) return fail(ErrorCode::kIo, "cannot open a window: no display");
  try {
    Player player("fbs: " + arguments.input);
    std::fprintf(stderr, "%s\n", Player::kKeys);
    for (;;) {
      auto file = open(arguments);
      if (!file) return fail(file.error());
      auto left = player.show(*file);
      if (!left) return fail(left.error());
      if (*left == Player::Leave::kQuit) return Outcome::kComplete;
    }
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::kIo, "cannot open a window: " + std::string(e.err));
  }
}

}  // namespace
}  // namespace fbs::cli

FBS_MODULE_EXPORT void fbs_run_play(const fbs::cli::PlayArguments& arguments,
                                    fbs::Result<fbs::cli::Outcome>& result) {
  result = fbs::cli::play(arguments);
}
