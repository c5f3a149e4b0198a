// What tells one state of the files of a source from another.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace fbs::cli {

/// Absolute path, size and time of change of a file; of a folder or an image sequence (`%`, `*`, `?` in the
/// name), those of all files in the folder. Of anything else, such as an address, a value that never comes
/// again.
[[nodiscard]] nlohmann::json file_stamp(const std::string& name);

/// The same of the program itself: what another build has made is made anew.
[[nodiscard]] nlohmann::json program_stamp();

}  // namespace fbs::cli
