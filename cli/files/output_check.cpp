#include "cli/files/output_check.h"

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>

namespace fbs::cli {
namespace {

namespace fs = std::filesystem;

/// The file a name refers to: an existing one, or one still to be created.
struct Place {
  std::optional<struct stat> existing;
  fs::path made;  ///< absolute, without links; only if there is none
};

Place place_of(const std::string& name) {
  Place place;
  struct stat status {};
  if (stat(name.c_str(), &status) == 0) {
    place.existing = status;
  } else {
    std::error_code unknown;
    place.made = fs::weakly_canonical(fs::absolute(name, unknown), unknown);
  }
  return place;
}

bool same_file(const Place& a, const Place& b) {
  if (a.existing && b.existing)
    return S_ISREG(a.existing->st_mode) && a.existing->st_dev == b.existing->st_dev &&
           a.existing->st_ino == b.existing->st_ino;
  return !a.existing && !b.existing && !a.made.empty() && a.made == b.made;
}

Result<void> check_pair(const NamedFile& written, const char* stream_of_written, const NamedFile& other,
                        const char* stream_of_other) {
  if (written.name.empty() || other.name.empty()) return {};
  const bool both_streams = written.name == "-" && other.name == "-";
  const bool same_stream = both_streams && std::string(stream_of_written) == stream_of_other;
  const Place a = place_of(written.name == "-" ? stream_of_written : written.name);
  const Place b = place_of(other.name == "-" ? stream_of_other : other.name);
  if (!same_stream && !same_file(a, b)) return {};
  return fail(ErrorCode::kInvalidArgument, written.role + " " + written.name + " is the same file as " +
                                               other.role + " " + other.name + "; nothing was written");
}

}  // namespace

bool is_device(const std::string& name) {
  struct stat status {};
  if (name.starts_with("/dev/") || name.starts_with("/proc/")) return true;
  return stat(name.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

std::string extension_of(const std::string& name) {
  std::string extension = fs::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Result<void> check_distinct(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const NamedFile& input : inputs)
      if (auto checked = check_pair(outputs[i], "/dev/stdout", input, "/dev/stdin"); !checked) return checked;
    for (const NamedFile& before : outputs.first(i))
      if (auto checked = check_pair(outputs[i], "/dev/stdout", before, "/dev/stdout"); !checked)
        return checked;
  }
  return {};
}

Result<void> check_stream_name(const std::string& output) {
  if (output == "-" || extension_of(output) == ".fbs" || is_device(output)) return {};
  const std::string better = fs::path(output).replace_extension(".fbs").string();
  return fail(ErrorCode::kUnsupported,
              "cannot write " + output + ": the name of a stream ends in .fbs; use " + better);
}

Result<void> check_picture_name(const std::string& output) {
  if (extension_of(output) != ".fbs") return {};
  return fail(ErrorCode::kUnsupported, "cannot write " + output +
                                           ": decode writes pictures, not a stream; use .y4m, .mp4, .mkv or "
                                           "frame_%05d.png");
}

void print_replaced_leftover(const std::string& output) {
  std::fprintf(stderr, "fbs: replaced %s.part, left by an earlier run\n", output.c_str());
}

Result<void> flush_standard_output() {
  if (std::fflush(stdout) != 0)
    return fail(ErrorCode::kIo, "cannot write standard output: " + std::generic_category().message(errno));
  if (std::ferror(stdout) != 0)  // an earlier write, whose reason is not known any more
    return fail(ErrorCode::kIo, "cannot write standard output");
  return {};
}

}  // namespace fbs::cli
