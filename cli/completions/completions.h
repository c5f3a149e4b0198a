// Completion of the command line by shells.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace fbs::cli {

/// A script with which the shell completes verbs and options of `app`, and file names.
[[nodiscard]] std::string bash_completions(const CLI::App& app);
[[nodiscard]] std::string zsh_completions(const CLI::App& app);
[[nodiscard]] std::string fish_completions(const CLI::App& app);

}  // namespace fbs::cli
