#include "cli/program/module.h"

#include <dlfcn.h>

#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

namespace fbs {
namespace {

namespace fs = std::filesystem;

/// Folders to search, in order; empty when the location of the executable is unknown.
std::vector<fs::path> module_folders() {
  std::error_code ignored;
  const fs::path executable = fs::read_symlink("/proc/self/exe", ignored);
  if (executable.empty()) return {};
  const fs::path folder = executable.parent_path();
  return {folder, folder.parent_path() / "lib" / "fbs"};
}

std::string linker_reason() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): modules are loaded by the main thread alone
  const char* text = dlerror();
  return text != nullptr ? text : "unknown reason";
}

Result<void*> open_module(const fs::path& file) {
  void* module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (module == nullptr) {
    return fail(ErrorCode::kUnsupported, "cannot load module " + file.string() + ": " + linker_reason());
  }
  auto* const version = reinterpret_cast<const char* (*)()>(dlsym(module, "fbs_module_version"));
  if (version == nullptr || std::string_view(version()) != FBS_VERSION) {
    return fail(ErrorCode::kUnsupported,
                "module " + file.string() + " does not belong to version " FBS_VERSION);
  }
  return module;
}

}  // namespace

Result<void*> load_module_symbol(const std::string& name, const char* symbol) {
  std::string searched;
  for (const fs::path& folder : module_folders()) {
    const fs::path file = folder / (name + ".so");
    std::error_code ignored;
    if (!fs::exists(file, ignored)) {
      searched += (searched.empty() ? "" : " and ") + folder.lexically_normal().string();
      continue;
    }
    return open_module(file).and_then([&](void* module) -> Result<void*> {
      void* const address = dlsym(module, symbol);
      if (address == nullptr) {
        return fail(ErrorCode::kUnsupported, "module " + file.string() + " has no function " + symbol);
      }
      return address;
    });
  }
  return fail(ErrorCode::kUnsupported,
              "module " + name + ".so not found; searched " + searched + FBS_MODULE_HINT);
}

}  // namespace fbs
