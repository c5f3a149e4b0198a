// snake_iterations: how many iterations the snakes need per picture, compared with the paper's 10 to 15.
//
//   snake_iterations [FOLDER | VIDEO ...]
//
// Without videos it uses the talker at noise 0, 3 and 6. One line for each kind of snake: median, 95th
// percentile and shares, over all pictures but the first. A restarted descent (more than 15) counts as one,
// with all its iterations.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/video/open/open_video.h"
#include "encoder/encoder.h"
#include "encoder/track/feature_tracker.h"
#include "tests/talker/talker_render.h"

namespace {

using namespace fbs;

constexpr double kMinConfidence = 0.55;  // below it no snake is run
/// Upper limits of the histogram's bins.
constexpr std::array<int, 6> kClasses = {4, 9, 15, 20, 30, 45};

/// Snakes of one kind: left and right count together.
struct Kind {
  const char* name;
  std::array<FeatureId, 2> features;
};
constexpr std::array<Kind, 4> kKinds = {{
    {"outer lips", {FeatureId::kMouthOuter, FeatureId::kMouthOuter}},
    {"inner lips", {FeatureId::kMouthInner, FeatureId::kMouthInner}},
    {"brows", {FeatureId::kBrowRight, FeatureId::kBrowLeft}},
    {"upper lids", {FeatureId::kUpperLidRight, FeatureId::kUpperLidLeft}},
}};

struct Counts {
  std::array<std::vector<int>, kKinds.size()> iterations;

  void take(const PictureAnalysis& analysis) {
    if (!analysis.face || analysis.confidence < kMinConfidence) return;
    for (std::size_t s = 0; s < std::min(analysis.snakes.size(), kSnakeFeatures.size()); ++s)
      for (std::size_t k = 0; k < kKinds.size(); ++k)
        if (std::ranges::find(kKinds[k].features, kSnakeFeatures[s]) != kKinds[k].features.end())
          iterations[k].push_back(analysis.snakes[s].iterations);
  }
  void add(const Counts& other) {
    for (std::size_t k = 0; k < kKinds.size(); ++k)
      iterations[k].insert(iterations[k].end(), other.iterations[k].begin(), other.iterations[k].end());
  }
};

void print_heading() {
  std::printf("%-24s %-11s %8s %7s %5s", "source", "snake", "pictures", "median", "95 %");
  int from = 0;
  for (const int to : kClasses) {
    std::printf("  %3d-%-3d", from, to);
    from = to + 1;
  }
  std::puts("   (percent)");
}

void print(const std::string& source, Counts counts) {
  for (std::size_t k = 0; k < kKinds.size(); ++k) {
    auto& n = counts.iterations[k];
    if (n.empty()) continue;
    std::ranges::sort(n);
    std::printf("%-24.24s %-11s %8zu %7d %5d", source.c_str(), kKinds[k].name, n.size(), n[n.size() / 2],
                n[n.size() * 95 / 100]);
    auto from = n.begin();
    for (const int to : kClasses) {
      const auto end = std::upper_bound(from, n.end(), to);
      std::printf(" %8.1f", 100.0 * static_cast<double>(end - from) / static_cast<double>(n.size()));
      from = end;
    }
    std::puts("");
  }
  std::fflush(stdout);
}

/// Analyses pictures until `next` has no more. Reports errors on standard error.
bool analyse(const VideoFormat& format, const std::function<bool(Picture&)>& next, Counts& counts) {
  EncoderSettings settings;
  settings.allow_no_face = true;
  settings.patterns = 1;  // the analysis does not depend on them
  auto encoder = Encoder::create(format, settings);
  if (!encoder) return std::fprintf(stderr, "%s\n", encoder.error().text.c_str()), false;
  Picture picture;
  for (bool first = true; next(picture); first = false) {
    if (auto pushed = encoder->push(picture); !pushed)
      return std::fprintf(stderr, "%s\n", pushed.error().text.c_str()), false;
    (void)encoder->take();
    if (!first) counts.take(encoder->analysis());
  }
  return true;
}

bool analyse_talker(float noise, Counts& counts) {
  talker::Settings settings;
  settings.noise = noise;
  const talker::Talker talker(settings);
  VideoFormat format;
  format.width = settings.width;
  format.height = settings.height;
  format.frame_rate = settings.frame_rate;
  int i = 0;
  return analyse(
      format, [&](Picture& p) { return i < settings.frame_count && (p = talker.picture(i++), true); },
      counts);
}

bool analyse_video(const std::string& name, Counts& counts) {
  auto source = open_video_source(name);
  if (!source) return std::fprintf(stderr, "%s\n", source.error().text.c_str()), false;
  return analyse((*source)->format(),
                 [&](Picture& p) {
                   auto got = (*source)->next();
                   if (!got || !*got) return false;
                   p = std::move((*got)->picture);
                   return true;
                 },
                 counts);
}

std::vector<std::string> videos_of(int argc, char** argv) {
  std::vector<std::string> out;
  for (int i = 1; i < argc; ++i) {
    if (!std::filesystem::is_directory(argv[i])) {
      out.emplace_back(argv[i]);
      continue;
    }
    for (const auto& entry : std::filesystem::directory_iterator(argv[i]))
      if (entry.path().extension() == ".mkv" || entry.path().extension() == ".y4m")
        out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  print_heading();
  Counts all;
  bool good = true;
  const auto done = [&](const std::string& name, const Counts& counts) {
    print(name, counts);
    all.add(counts);
  };
  const auto videos = videos_of(argc, argv);
  for (const std::string& video : videos) {
    Counts counts;
    good = analyse_video(video, counts) && good;
    done(std::filesystem::path(video).stem(), counts);
  }
  if (videos.empty()) {
    for (const float noise : {0.0F, 3.0F, 6.0F}) {
      Counts counts;
      good = analyse_talker(noise, counts) && good;
      done("talker, noise " + std::to_string(static_cast<int>(noise)), counts);
    }
  }
  print("all", all);
  return good ? 0 : 1;
}
