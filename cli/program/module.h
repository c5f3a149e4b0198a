// Modules: parts of the program that need large libraries, loaded only by the verbs that use them.
//
// Linking OpenCV, OpenImageIO and libav into `fbs` would cost every run 240 ms before main() begins. They
// live in shared modules next to the program instead (`fbs_av.so`, ...; installed in lib/fbs), which cmake's
// `fbs_add_module` builds (cli/program/module.cmake). A module exports plain functions marked
// FBS_MODULE_EXPORT.
#pragma once

#include <string>

#include "common/result.h"

/// Marks a function that load_module_function finds by its name.
#define FBS_MODULE_EXPORT extern "C" __attribute__((visibility("default")))

namespace fbs {

/// In every module, for `fbs doctor`: `const char* fbs_module_libraries()` returns a line "NAME VERSION" for
/// each big library that is loaded with it.
inline constexpr const char* kLibrariesSymbol = "fbs_module_libraries";

/// Loads `name` (`fbs_av`, without folder or `.so`) and finds `symbol` in it. The module is looked for in the
/// folder of the running executable, then in its ../lib/fbs, and stays loaded until the program ends, so that
/// objects it made may be destroyed at any time. Loading twice is cheap.
/// @return never null; ErrorCode::kUnsupported when the module is not found (the text lists the folders
/// searched),
///         cannot be loaded (with the linker's reason) or belongs to another version of the program
Result<void*> load_module_symbol(const std::string& name, const char* symbol);

/// The same as a function pointer: `load_module_function<void(int)>("fbs_av", "fbs_av_open")`.
template <class Function>
Result<Function*> load_module_function(const std::string& name, const char* symbol) {
  return load_module_symbol(name, symbol).map([](void* address) {
    return reinterpret_cast<Function*>(address);
  });
}

}  // namespace fbs
