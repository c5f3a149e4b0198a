// Structs of settings whose size the caller gives, so that program and library may differ in version.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "common/hooks.h"

namespace fbs {

/// Fills a caller's struct of the size given. Members that only the caller knows become 0.
/// @param first_size  size of the struct in the first version that had it; smaller ones are left alone
template <class Settings>
void give_defaults(const Settings& defaults, Settings* out, std::size_t struct_size, std::size_t first_size) {
  if (out == nullptr || struct_size < first_size) return;
  Settings known = defaults;
  known.struct_size = struct_size;
  std::memset(static_cast<void*>(out), 0, struct_size);
  std::memcpy(static_cast<void*>(out), &known, std::min(struct_size, sizeof known));
}

/// Reads a caller's struct. Members that only we know keep their values in `settings`, the defaults.
/// @return false when it is too small, or has a member unknown to us that is not 0
template <class Settings>
[[nodiscard]] bool take_settings(const Settings& from, std::size_t first_size, Settings& settings) {
  const std::size_t size = from.struct_size;
  if (size < first_size) return false;
  std::memcpy(static_cast<void*>(&settings), &from, std::min(size, sizeof settings));
  if (size <= sizeof settings) return true;
  const auto* const bytes = reinterpret_cast<const unsigned char*>(&from);
  return std::all_of(bytes + sizeof settings, bytes + size, [](unsigned char byte) { return byte == 0; });
}

/// The hooks of settings of a decoder or an encoder.
template <class Settings>
[[nodiscard]] Hooks hooks_of(const Settings& settings) {
  return {settings.log, settings.thread_start, settings.user};
}

}  // namespace fbs
