// `fbs completions`: a script that teaches a shell the command line.
#include <cstdio>
#include <string>

#include "cli/command_line/verb.h"
#include "cli/completions/completions.h"

namespace fbs::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  source <(fbs completions bash)                            in ~/.bashrc\n"
    "  source <(fbs completions zsh)                             in ~/.zshrc, after compinit\n"
    "  fbs completions fish > ~/.config/fish/completions/fbs.fish";

Result<Outcome> print_completions(const CLI::App& app, const std::string& shell) {
  const std::string script = shell == "bash"  ? bash_completions(app)
                             : shell == "zsh" ? zsh_completions(app)
                                              : fish_completions(app);
  std::fputs(script.c_str(), stdout);
  return Outcome::kComplete;
}

}  // namespace

void add_completions(CLI::App& app, Run& run) {
  const auto [verb, shell] = new_verb<std::string>(
      app, run, "completions", "Print a script that completes verbs and options in a shell",
      [&app](const std::string& name) { return print_completions(app, name); });
  verb->add_option("SHELL", shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  verb->footer(kExamples);
}

}  // namespace fbs::cli
