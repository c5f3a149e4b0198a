// `fbs completions`: a script that teaches a shell the command line.
#include <cstdio>
#include <memory>

#include "cli/completions/completions.h"
#include "cli/verb.h"

namespace fbs::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  source <(fbs completions bash)                            in ~/.bashrc\n"
    "  source <(fbs completions zsh)                             in ~/.zshrc, after compinit\n"
    "  fbs completions fish > ~/.config/fish/completions/fbs.fish";

}  // namespace

void add_completions(CLI::App& app, Run& run) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* verb =
      app.add_subcommand("completions", "Print a script that completes verbs and options in a shell");
  verb->add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  verb->footer(kExamples);
  verb->callback([&run, &app, shell] {
    run = [&app, shell]() -> Result<Outcome> {
      const std::string script = *shell == "bash"  ? bash_completions(app)
                                 : *shell == "zsh" ? zsh_completions(app)
                                                   : fish_completions(app);
      std::fputs(script.c_str(), stdout);
      return Outcome::kComplete;
    };
  });
}

}  // namespace fbs::cli
