#include "tests/talker/talker_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <utility>

namespace fbs::talker {
namespace {

template <class T>
bool number(std::string_view text, T low, T high, T& value) {
  T read{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read);
  if (error != std::errc{} || end != text.data() + text.size() || !(read >= low && read <= high))
    return false;
  value = read;
  return true;
}

bool size(std::string_view text, Settings& s) {
  const auto cross = text.find('x');
  return cross != std::string_view::npos &&
         number(text.substr(0, cross), kMinPictureSize, kMaxPictureSize, s.width) &&
         number(text.substr(cross + 1), kMinPictureSize, kMaxPictureSize, s.height);
}

/// "30", "30000/1001" or "29.97" (to three decimals).
bool rate(std::string_view text, Rational& r) {
  const auto slash = text.find_first_of("/:");
  if (slash != std::string_view::npos) {
    return number(text.substr(0, slash), 1u, 1000000u, r.num) &&
           number(text.substr(slash + 1), 1u, 1000000u, r.den);
  }
  if (number(text, 1u, 1000u, r.num)) {
    r.den = 1;
    return true;
  }
  double decimal = 0;
  if (!number(text, 0.001, 1000.0, decimal)) return false;
  r = {static_cast<std::uint32_t>(std::lround(decimal * 1000)), 1000};
  return true;
}

bool motion(std::string_view text, Motion& m) {
  constexpr std::array<std::pair<std::string_view, Motion>, 6> kNames{{{"default", Motion::kDefault},
                                                                       {"turns", Motion::kTurns},
                                                                       {"talk", Motion::kTalk},
                                                                       {"brows", Motion::kBrows},
                                                                       {"blink", Motion::kBlink},
                                                                       {"long", Motion::kLong}}};
  const auto found = std::ranges::find(kNames, text, &std::pair<std::string_view, Motion>::first);
  if (found == kNames.end()) return false;
  m = found->second;
  return true;
}

struct Option {
  std::string_view name;
  std::function<bool(std::string_view, Options&)> read;
};

const std::array<Option, 14>& valued_options() {
  using Text = std::string_view;
  static const std::array<Option, 14> options{{
      {"--truth",
       [](Text t, Options& o) {
         o.truth = t;
         return !t.empty();
       }},
      {"--marks",
       [](Text t, Options& o) {
         o.marks = t;
         return !t.empty();
       }},
      {"--size", [](Text t, Options& o) { return size(t, o.settings); }},
      {"--fps", [](Text t, Options& o) { return rate(t, o.settings.frame_rate); }},
      {"--motion", [](Text t, Options& o) { return motion(t, o.settings.motion); }},
      {"--frames", [](Text t, Options& o) { return number(t, 1, 10000000, o.settings.frame_count); }},
      {"--seed", [](Text t, Options& o) { return number(t, 0u, 0xFFFFFFFFu, o.settings.seed); }},
      {"--noise", [](Text t, Options& o) { return number(t, 0.0f, 64.0f, o.settings.noise); }},
      {"--yaw", [](Text t, Options& o) { return number(t, 0.0f, 60.0f, o.settings.yaw_deg); }},
      {"--pitch", [](Text t, Options& o) { return number(t, 0.0f, 45.0f, o.settings.pitch_deg); }},
      {"--roll", [](Text t, Options& o) { return number(t, 0.0f, 60.0f, o.settings.roll_deg); }},
      {"--scale", [](Text t, Options& o) { return number(t, 0.0f, 0.5f, o.settings.scale); }},
      {"--light", [](Text t, Options& o) { return number(t, 0.0f, 0.9f, o.settings.light); }},
      {"--eye-distance", [](Text t, Options& o) { return number(t, 0.03f, 0.3f, o.settings.eye_distance); }},
  }};
  return options;
}

}  // namespace

const std::string_view kUsage =
    "usage: talker OUT.y4m [options]     OUT.y4m may be - for standard output\n"
    "  --truth OUT.csv          pose, 68 points and openings of every frame\n"
    "  --marks OUT.json         the 68 points of frame 0\n"
    "  --size 352x288           pixels\n"
    "  --frames 300\n"
    "  --fps 30                 also 30000/1001\n"
    "  --seed 1                 another seed: other motion, texture and person\n"
    "  --noise 0                deviation of the camera noise, 8-bit levels\n"
    "  --yaw 12 --pitch 6 --roll 5   amplitudes of the head's motion, degrees\n"
    "  --scale 0.06             amplitude of the change of size, fraction\n"
    "  --light 0                amplitude of the change of light, fraction\n"
    "  --eye-distance 0.15      size of the face, fraction of the picture's height\n"
    "  --still                  hold the head; the face goes on\n"
    "  --motion default|turns|talk|brows|blink|long\n";

std::optional<Options> parse_options(std::span<char* const> arguments, std::string& complaint) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view argument = arguments[i];
    if (argument == "--help" || argument == "-h") {
      options.help = true;
      return options;
    }
    if (argument == "--still") {
      options.settings.still = true;
    } else if (argument.starts_with("--")) {
      const auto option = std::ranges::find(valued_options(), argument, &Option::name);
      if (option == valued_options().end()) {
        complaint = "unknown option " + std::string(argument);
        return std::nullopt;
      }
      if (++i == arguments.size() || !option->read(arguments[i], options)) {
        complaint = std::string(argument) + " needs a proper value";
        return std::nullopt;
      }
    } else if (options.video.empty()) {
      options.video = argument;
    } else {
      complaint = "more than one output: " + std::string(argument);
      return std::nullopt;
    }
  }
  if (options.video.empty()) {
    complaint = "no output file";
    return std::nullopt;
  }
  return options;
}

}  // namespace fbs::talker
