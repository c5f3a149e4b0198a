#include "cli/command_line/verb.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace fbs::cli {

CLI::Validator number_within(double low, double high) {
  std::array<char, 64> range{};
  std::snprintf(range.data(), range.size(), "[%g - %g]", low, high);
  const auto check = [low, high](const std::string& text) -> std::string {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end != text.c_str() && *end == '\0' && value >= low && value <= high) return {};
    std::array<char, 64> limits{};
    std::snprintf(limits.data(), limits.size(), " not in range %g to %g", low, high);
    return "Value " + text + limits.data();
  };
  return {check, std::string("FLOAT in ") + range.data()};
}

void add_from(CLI::App& verb, double& from) {
  verb.add_option("--from", from, "Begin with the picture of this time")
      ->check(number_within(0, kMaxSeconds))
      ->type_name("SECONDS");
}

void add_rotate(CLI::App& verb, int& degrees) {
  verb.add_option("--rotate", degrees, "Turn the pictures clockwise, where the video lies on its side")
      ->check(CLI::IsMember({90, 180, 270}))
      ->type_name("90|180|270");
}

}  // namespace fbs::cli
