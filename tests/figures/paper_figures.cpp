// paper_figures OUT_FOLDER [CLIPS_FOLDER]: writes Figures 1 to 7 of the paper as PNG, from the talker and
// from each video of a folder. See README.md.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/figures/figures.h"

namespace fbs::figures {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kTalkerSeed = 1, kNeighbourSeed = 4;  // two people of tests/talker

/// Exceptions end here.
template <class T>
T must(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().text);
  return std::move(*result);
}

void write(const fs::path& file, const cv::Mat3b& image) {
  if (!cv::imwrite(file.string(), image)) throw std::runtime_error("cannot write " + file.string());
}

/// A line for tests and for reading: heights in eye distances.
void print(const std::string& name, const TeethHeights& h) {
  std::printf("teeth %s without %.3f with %.3f true %.3f\n", name.c_str(), h.without, h.with, h.truth);
}

using Stream = std::vector<std::uint8_t>;

/// @param other  whose face takes over the motion
/// @return the footage's own stream, which takes over another's motion
Stream draw_figures(const Footage& footage, const Stream& other, const fs::path& out) {
  const Paths paths{must(follow(footage, paper_settings())), must(follow(footage, {}))};
  const Followed& followed = paths.fitted;
  const auto file = [&](const char* figure) { return out / (footage.name + "_" + figure + ".png"); };
  const SnakeFigure snakes = snake_figure(footage, followed);
  write(file("figure1"), snakes.image);
  print(footage.name, snakes.teeth);
  write(file("figure3"), must(adaptation_figure(footage, followed)));
  write(file("figure4"), must(animation_figure(footage, paths.paper)));
  write(file("figure5"), must(mouth_figure(footage, paths)));
  write(file("figure6"), must(brow_figure(footage, paths)));
  const SynthesisFigure synthesis = must(synthesis_figure(footage, paths, other));
  write(file("figure7"), synthesis.image);
  std::printf("lips %s own %.3f %.3f other %.3f %.3f\n", footage.name.c_str(), synthesis.own[0],
              synthesis.own[1], synthesis.other[0], synthesis.other[1]);
  return paths.paper.stream;
}

std::vector<fs::path> videos(const fs::path& folder) {
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(folder))
    for (const char* kind : {".mkv", ".mp4", ".y4m"})
      if (entry.path().extension() == kind) out.push_back(entry.path());
  std::sort(out.begin(), out.end());
  return out;
}

/// A clip that fails does not affect the others. The motion of each is also applied to the face before it.
int draw_clips(const fs::path& folder, Stream other, const fs::path& out) {
  int failed = 0;
  for (const fs::path& video : videos(folder)) {
    try {
      other = draw_figures(must(clip_footage(video.string())), other, out);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "paper_figures: %s: %s\n", video.c_str(), e.what());
      ++failed;
    }
  }
  return failed;
}

}  // namespace
}  // namespace fbs::figures

int main(int argc, char** argv) {
  using namespace fbs::figures;
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: paper_figures OUT_FOLDER [CLIPS_FOLDER]\n");
    return 2;
  }
  try {
    const fs::path out = argv[1];
    fs::create_directories(out);
    write(out / "figure2.png", wire_frame_figure());
    const SnakeFigure painted = painted_snake_figure();
    write(out / "painted_figure1.png", painted.image);
    print("painted", painted.teeth);
    const Footage neighbour = talker_footage("neighbour", kNeighbourSeed);
    const Stream other = must(follow(neighbour, paper_settings())).stream;
    const Stream talker = draw_figures(talker_footage("talker", kTalkerSeed), other, out);
    return argc == 3 && draw_clips(argv[2], talker, out) > 0 ? 1 : 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "paper_figures: %s\n", e.what());
    return 1;
  }
}
