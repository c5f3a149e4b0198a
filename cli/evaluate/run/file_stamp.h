// Identifies a state of a source's files.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace fbs::cli {

/// Absolute path, size and time of change of a file; for a folder or an image sequence (`%`, `*`, `?` in the
/// name), of all files in the folder. For anything else, such as an address, a value that never recurs.
[[nodiscard]] nlohmann::json file_stamp(const std::string& name);

/// The same for the program itself: results of another build are made anew.
[[nodiscard]] nlohmann::json program_stamp();

}  // namespace fbs::cli
