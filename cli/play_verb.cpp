// fbs play: shows a stream in a window.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <opencv2/highgui.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/module.h"
#include "cli/stream_file.h"
#include "cli/verbs.h"
#include "cli/video/colour.h"

namespace fbs::cli {
namespace {

constexpr const char* kKeys = "space: pause   .: step   r: restart   q: quit";
constexpr int kWantedHeight = 576;

bool has_display() {
  const auto set = [](const char* name) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): no thread changes the environment
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY") || set("QT_QPA_PLATFORM");
}

enum class Leave : std::uint8_t { kQuit, kRestart };

/// Shows the stream once.
Result<Leave> show(const PlayArguments& arguments, const std::string& window) {
  using Clock = std::chrono::steady_clock;
  auto file = StreamFile::open(arguments.input);
  if (!file) return fail(file.error());
  StreamDecoder& decoder = file->decoder();
  Picture picture;
  bool paused = false;
  auto due = Clock::now();
  for (;;) {
    auto status = file->next();
    if (!status) return fail(status.error());
    const bool ended = *status == DecodeStatus::kEnd;
    if (ended && decoder.pictures() == 0)
      return fail(ErrorCode::kInvalidStream, arguments.input + ": contains no pictures");
    if (!ended) {
      if (auto drawn = decoder.render(picture); !drawn) return fail(drawn.error());
      const VideoFormat& f = decoder.format();
      RgbImage rgb = rgb_from_picture(picture, f.range, f.matrix, ChannelOrder::kBgr);
      cv::Mat image(rgb.height, rgb.width, CV_8UC3, rgb.samples.data()), large;
      const int zoom = std::clamp(kWantedHeight / f.height, 1, 4);
      cv::resize(image, large, {}, zoom, zoom, cv::INTER_CUBIC);
      cv::imshow(window, large);
      due += std::chrono::microseconds(static_cast<std::int64_t>(decoder.duration()) * 100 / 9);
    }
    for (;;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(due - Clock::now()).count();
      const bool waiting = paused || ended;
      const int key = cv::waitKey(waiting ? 50 : static_cast<int>(std::clamp<long long>(left, 1, 1000)));
      if (key == 'q' || key == 27 || cv::getWindowProperty(window, cv::WND_PROP_VISIBLE) < 1)
        return Leave::kQuit;
      if (key == 'r') return Leave::kRestart;
      if (key == ' ') {
        paused = !paused;
        due = Clock::now();
      }
      if (key == '.' && !ended) {
        paused = true;
        break;
      }
      if (!paused && !ended && Clock::now() >= due) break;
    }
  }
}

Result<void> play(const PlayArguments& arguments) {
  // Decode one picture first, so that a bad stream gives an error and no window.
  auto probe = StreamFile::open(arguments.input);
  if (!probe) return fail(probe.error());
  if (auto first = probe->next(); !first) return fail(first.error());
  // highgui aborts the program when there is no display.
  if (!has_display()) return fail(ErrorCode::kIo, "cannot open a window: no display");
  try {
    const std::string window = "fbs: " + arguments.input;
    cv::namedWindow(window, cv::WINDOW_AUTOSIZE);
    std::fprintf(stderr, "%s\n", kKeys);
    for (;;) {
      auto left = show(arguments, window);
      if (!left) return fail(left.error());
      if (*left == Leave::kQuit) return {};
    }
  } catch (const cv::Exception& e) {
    return fail(ErrorCode::kIo, "cannot open a window: " + std::string(e.err));
  }
}

}  // namespace
}  // namespace fbs::cli

FBS_MODULE_EXPORT void fbs_run_play(const fbs::cli::PlayArguments& arguments, fbs::Result<void>& result) {
  result = fbs::cli::play(arguments);
}
