// `fbs completions`: a script that teaches a shell the command line.
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command_line/help_formatter.h"
#include "cli/command_line/verb.h"

namespace fbs::cli {
namespace {

constexpr const char* kCompletionsExamples =
    "Examples:\n"
    "  source <(fbs completions bash)                            in ~/.bashrc\n"
    "  source <(fbs completions zsh)                             in ~/.zshrc, after compinit\n"
    "  fbs completions fish > ~/.config/fish/completions/fbs.fish";

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

/// The options that --help shows and that have a name with two dashes.
std::vector<const CLI::Option*> options_of(const CLI::App& verb) {
  return verb.get_options(
      [](const CLI::Option* o) { return !o->get_lnames().empty() && o->get_group() != kHiddenGroup; });
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

/// Quotes text for a shell, in single quotes.
std::string in_quotes(const std::string& text) {
  std::string out = "'";
  out += replaced(text, "'", "'\\''");
  return out += "'";
}

/// The first sentence: a menu has one line per option.
std::string short_text(const std::string& description) {
  return description.substr(0, description.find_first_of(";:("));
}

bool takes_file(const CLI::Option& option) {
  const std::string value = value_of(option);
  return value == "FILE" || value == "[FILE]" || value == "STREAM" || value == "STREAM|PICTURE" ||
         value == "DIR";
}

std::string bash_completions(const CLI::App& app) {
  std::ostringstream names, cases;
  for (const CLI::App* verb : verbs_of(app)) {
    names << verb->get_name() << ' ';
    cases << "    " << verb->get_name() << ") options=\"";
    for (const CLI::Option* option : options_of(*verb))
      for (const std::string& name : option->get_lnames()) cases << "--" << name << ' ';
    cases << "\" ;;\n";
  }
  std::ostringstream out;
  out << "_fbs() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} options\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W \""
      << names.str()
      << "--help --version\" -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]} in\n"
      << cases.str()
      << "  esac\n"
         "  case $word in\n"
         "    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
         "    *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
         "  esac\n"
         "}\n"
         "complete -o filenames -F _fbs fbs\n";
  return out.str();
}

std::string zsh_completions(const CLI::App& app) {
  const auto escaped = [](const std::string& text) {
    return replaced(replaced(replaced(text, "[", "\\["), "]", "\\]"), ":", "\\:");
  };
  std::ostringstream names, cases;
  for (const CLI::App* verb : verbs_of(app)) {
    names << "    " << in_quotes(verb->get_name() + ":" + escaped(verb->get_description())) << '\n';
    cases << "  " << verb->get_name() << ") _arguments";
    for (const CLI::Option* option : options_of(*verb))
      for (const std::string& name : option->get_lnames()) {
        std::ostringstream spec;
        spec << "--" << name << '[' << escaped(short_text(option->get_description())) << ']';
        if (const std::string value = value_of(*option); !value.empty())
          spec << ':' << escaped(value) << ':' << (takes_file(*option) ? "_files" : "");
        cases << " \\\n    " << in_quotes(spec.str());
      }
    cases << " \\\n    '*:file:_files' ;;\n";
  }
  std::ostringstream out;
  out << "#compdef fbs\n"
         "_fbs() {\n"
         "  local -a verbs=(\n"
      << names.str()
      << "  )\n"
         "  if (( CURRENT == 2 )); then\n"
         "    _describe verb verbs\n"
         "    return\n"
         "  fi\n"
         "  local verb=$words[2]\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "  case $verb in\n"
      << cases.str()
      << "  esac\n"
         "}\n"
         "compdef _fbs fbs\n";
  return out.str();
}

std::string fish_completions(const CLI::App& app) {
  std::ostringstream out;
  for (const CLI::App* verb : verbs_of(app)) {
    out << "complete -c fbs -f -n __fish_use_subcommand -a " << verb->get_name() << " -d "
        << in_quotes(verb->get_description()) << '\n';
    for (const CLI::Option* option : options_of(*verb))
      for (const std::string& name : option->get_lnames()) {
        out << "complete -c fbs -n '__fish_seen_subcommand_from " << verb->get_name() << "' -l " << name
            << " -d " << in_quotes(short_text(option->get_description()));
        if (!value_of(*option).empty()) out << (takes_file(*option) ? " -r" : " -x");
        out << '\n';
      }
  }
  return out.str();
}

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
  verb->footer(kCompletionsExamples);
}

}  // namespace fbs::cli
