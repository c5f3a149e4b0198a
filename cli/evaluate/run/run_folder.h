// The folder that keeps finished results of a run, so that the next one continues from there.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/result.h"

namespace fbs::cli {

/// A finished result is `NAME.json`, which holds its key (what it was made from) and its value. It appears
/// under its name only when complete; a result with another key is made anew.
class RunFolder {
 public:
  /// Creates the folder and its parents if needed.
  /// @return kIo with the system's reason
  static Result<RunFolder> open(const std::string& path);
  /// A new folder in TMPDIR that the destructor removes with its content.
  static Result<RunFolder> temporary();

  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  RunFolder(RunFolder&& other) noexcept;
  RunFolder& operator=(RunFolder&&) = delete;
  ~RunFolder();

  /// Path of a file in the folder.
  [[nodiscard]] std::string path(const std::string& name) const { return path_ + "/" + name; }

  /// @return the value; nothing if it is missing, unreadable, or was made from something else
  [[nodiscard]] std::optional<nlohmann::json> find(const std::string& name, const nlohmann::json& key) const;
  Result<void> keep(const std::string& name, const nlohmann::json& key, nlohmann::json value) const;

 private:
  RunFolder(std::string path, bool removed) : path_(std::move(path)), removed_(removed) {}

  std::string path_;
  bool removed_;  ///< by the destructor
};

}  // namespace fbs::cli
