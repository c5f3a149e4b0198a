#include "cli/evaluate/run/file_stamp.h"

#include <dlfcn.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <vector>

namespace fbs::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json stamp_of_file(const fs::path& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  const auto changed = fs::last_write_time(path, error).time_since_epoch().count();
  return json::array({path.string(), size, changed});
}

json stamp_of_folder(const fs::path& folder) {
  std::vector<json> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.is_regular_file(error)) files.push_back(stamp_of_file(entry.path()));
  std::sort(files.begin(), files.end());
  return std::hash<json>{}(json(files));
}

}  // namespace

json file_stamp(const std::string& name) {
  std::error_code error;
  const fs::path path = fs::absolute(name, error).lexically_normal();
  if (fs::is_regular_file(path, error)) return stamp_of_file(path);
  if (fs::is_directory(path, error)) return json::array({path.string(), stamp_of_folder(path)});
  if (name.find_first_of("%*?") != std::string::npos && fs::is_directory(path.parent_path(), error))
    return json::array({path.string(), stamp_of_folder(path.parent_path())});
  return json::array({name, std::chrono::system_clock::now().time_since_epoch().count()});
}

json program_stamp() {
  Dl_info info{};
  const auto here = reinterpret_cast<const void*>(&program_stamp);
  if (dladdr(here, &info) == 0 || info.dli_fname == nullptr) return FBS_VERSION;
  return json::array({FBS_VERSION, file_stamp(info.dli_fname)});
}

}  // namespace fbs::cli
