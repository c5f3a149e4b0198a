#include "cli/evaluate/run/run_folder.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <system_error>
#include <utility>

#include "cli/files/atomic_file.h"

namespace fbs::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

}  // namespace

Result<RunFolder> RunFolder::open(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) return fail(ErrorCode::kIo, path + ": cannot make the folder: " + error.message());
  if (!fs::is_directory(path)) return fail(ErrorCode::kIo, path + ": is not a folder");
  return RunFolder(path, false);
}

Result<RunFolder> RunFolder::temporary() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  std::string name = (parent / "fbs-evaluate-XXXXXX").string();
  if (error || mkdtemp(name.data()) == nullptr)
    return fail(ErrorCode::kIo, "temporary directory: cannot make a folder: " +
                                    (error ? error.message() : std::generic_category().message(errno)));
  return RunFolder(std::move(name), true);
}

RunFolder::RunFolder(RunFolder&& other) noexcept
    : path_(std::move(other.path_)), removed_(std::exchange(other.removed_, false)) {}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (removed_) fs::remove_all(path_, ignored);
}

std::optional<json> RunFolder::find(const std::string& name, const json& key) const {
  std::ifstream file(path(name + ".json"));
  if (!file) return std::nullopt;
  json read = json::parse(file, nullptr, false);
  if (!read.is_object() || !read.contains("value") || read.value("key", json()) != key) return std::nullopt;
  return std::move(read["value"]);
}

Result<void> RunFolder::keep(const std::string& name, const json& key, json value) const {
  auto file = AtomicFile::create(path(name + ".json"));
  if (!file) return fail(file.error());
  const std::string text = json{{"key", key}, {"value", std::move(value)}}.dump() + "\n";
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  return file->write(bytes).and_then([&] { return file->commit(); });
}

}  // namespace fbs::cli
