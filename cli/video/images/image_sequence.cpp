#include "cli/video/images/image_sequence.h"

#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>

#include "cli/files/number_pattern.h"

namespace fbs {
namespace {

namespace fs = std::filesystem;

/// The leading run of digits without its leading zeros; removed from `text`.
std::string_view take_number(std::string_view& text) {
  const auto end =
      static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

/// "frame9" before "frame10": runs of digits compare as numbers.
bool in_number_order(const std::string& left, const std::string& right) {
  std::string_view a = left;
  std::string_view b = right;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view m = take_number(a);
      const std::string_view n = take_number(b);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else {
      if (a[0] != b[0]) return a[0] < b[0];
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  return a.empty() != b.empty() ? a.empty() : left < right;
}

std::string suffix_of(const std::string& name) {
  std::string suffix = fs::path(name).extension().string();
  if (!suffix.empty()) suffix.erase(0, 1);
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

}  // namespace

Result<std::vector<std::string>> image_sequence_files(const std::string& input,
                                                      bool (*is_image_suffix)(const std::string&)) {
  std::error_code error;
  const bool whole_folder = fs::is_directory(input, error);
  const fs::path folder = whole_folder ? fs::path(input) : fs::path(input).parent_path();
  const std::string wanted = fs::path(input).filename().string();
  const auto numbered = parse_number_pattern(wanted);

  std::function<bool(const std::string&)> belongs;
  if (whole_folder) {
    belongs = [&](const std::string& name) { return name[0] != '.' && is_image_suffix(suffix_of(name)); };
  } else if (numbered) {
    belongs = [&](const std::string& name) { return numbered->number(name).has_value(); };
  } else {
    belongs = [&](const std::string& name) { return fnmatch(wanted.c_str(), name.c_str(), FNM_PERIOD) == 0; };
  }

  std::vector<std::string> files;
  fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (belongs(name)) files.push_back((folder / name).string());
  }
  if (error) return fail(ErrorCode::kIo, "cannot read " + input + ": " + error.message());
  if (files.empty()) return fail(ErrorCode::kIo, "cannot read " + input + ": no such images");
  std::sort(files.begin(), files.end(), in_number_order);
  return files;
}

}  // namespace fbs
