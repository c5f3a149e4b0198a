// How --help looks: what an option takes in a few words, and lines that fit the terminal.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace fbs::cli {

/// CLI11's own way writes "INT:INT in [0 - 100]=50 Excludes: --bitrate" and does not break lines.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();
  /// Leaves out the hidden options. CLI11's own way, an empty group, would also leave their names out of
  /// errors.
  [[nodiscard]] std::string make_group(std::string group, bool is_positional,
                                       std::vector<const CLI::Option*> options) const override;
  [[nodiscard]] std::string make_option(const CLI::Option* option, bool is_positional) const override;
};

/// What an option takes: "0..100", "FILE"; empty for flags.
[[nodiscard]] std::string value_of(const CLI::Option& option);

/// Breaks `text` at spaces into lines of at most `width` characters; a longer word has a line of its own.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, std::size_t width);

}  // namespace fbs::cli
