// The folder that keeps what a run has finished, so that the next one goes on from there.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "common/result.h"

namespace fbs::cli {

/// A thing that is finished is `NAME.json`, which holds what it was made of, its key, and its value. It
/// appears under its name only when complete; what has another key is made anew.
class RunFolder {
 public:
  /// Makes the folder and its parents where needed.
  /// @return kIo with the system's reason
  static Result<RunFolder> open(const std::string& path);
  /// A folder of its own in TMPDIR that the destructor removes with all that is in it.
  static Result<RunFolder> temporary();

  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  RunFolder(RunFolder&& other) noexcept;
  RunFolder& operator=(RunFolder&&) = delete;
  ~RunFolder();

  /// Path of a file in the folder.
  [[nodiscard]] std::string path(const std::string& name) const { return path_ + "/" + name; }

  /// @return the value; nothing if it is not there, unreadable, or was made of something else
  [[nodiscard]] std::optional<nlohmann::json> find(const std::string& name, const nlohmann::json& key) const;
  Result<void> keep(const std::string& name, const nlohmann::json& key, nlohmann::json value) const;

 private:
  RunFolder(std::string path, bool removed) : path_(std::move(path)), removed_(removed) {}

  std::string path_;
  bool removed_;  ///< by the destructor
};

}  // namespace fbs::cli
