#include "cli/command_line/help_formatter.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>
#include <string_view>

#include "cli/command_line/verb.h"

namespace fbs::cli {
namespace {

constexpr std::size_t kNameColumns = 28;  ///< before the text of an option
constexpr std::size_t kColumns = 100;     ///< where the output is no terminal

std::size_t columns() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kColumns;
  return std::clamp<std::size_t>(size.ws_col, 60, kColumns);
}

}  // namespace

std::string value_of(const CLI::Option& option) {
  if (option.get_type_size() == 0) return "";
  const std::string type = option.get_type_name();
  std::string name = type.substr(0, type.find(':'));
  constexpr std::string_view kRange = " in [", kTo = " - ";
  if (const std::size_t range = type.find(kRange); range != std::string::npos) {
    if (name != "INT" && name != "UINT" && !name.starts_with("FLOAT")) return name;
    std::string limits = type.substr(range + kRange.size());
    limits.erase(limits.find(']'));
    if (const std::size_t to = limits.find(kTo); to != std::string::npos)
      limits.replace(to, kTo.size(), "..");
    return limits;
  }
  return name == "TEXT" ? "FILE" : name;
}

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || lines.back().size() + 1 + word.size() > width)
      lines.push_back(word);
    else
      lines.back() += " " + word;
  }
  return lines;
}

HelpFormatter::HelpFormatter() {
  column_width(kNameColumns);
  label("SUBCOMMAND", "VERB");
}

std::string HelpFormatter::make_group(std::string group, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
  return group == kHiddenGroup ? "" : Formatter::make_group(std::move(group), is_positional, options);
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
  std::string name = "  " + option->get_name(is_positional, !is_positional);
  if (const auto extra = name.find('{'); extra != std::string::npos) name.erase(extra);  // of !--no-live
  if (!is_positional && !value_of(*option).empty()) name += " " + value_of(*option);
  if (option->get_expected_max() > 1) name += " ...";
  std::string text = option->get_description();
  if (option->get_required() && !is_positional) text += " (required)";
  if (!option->get_default_str().empty()) text += " (default: " + option->get_default_str() + ")";
  const auto lines = wrapped(text, columns() - kNameColumns);
  std::string out = name;
  bool beside = name.size() + 2 <= kNameColumns;
  std::size_t at = name.size();
  for (const std::string& line : lines) {
    if (!beside) out += "\n", at = 0;
    out += std::string(kNameColumns - at, ' ') + line;
    beside = false;
  }
  return out + "\n";
}

}  // namespace fbs::cli
