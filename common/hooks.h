// What an embedder is told, and does to threads.
#pragma once

#include <string>

namespace fbs {

enum class LogLevel : int { kError, kWarning, kInfo, kDebug };

/// Functions of an embedder's, or null. Any thread may call them.
struct Hooks {
  void (*log)(void* user, int level, const char* text) = nullptr;
  /// @param name  of at most 15 characters
  void (*thread_start)(void* user, const char* name) = nullptr;
  void* user = nullptr;

  [[nodiscard]] bool logs() const { return log != nullptr; }
  /// @param text  one line
  void say(LogLevel level, const std::string& text) const {
    if (log != nullptr) log(user, static_cast<int>(level), text.c_str());
  }
};

}  // namespace fbs
