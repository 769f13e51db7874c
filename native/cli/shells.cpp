#include "tessera/cli/shells.h"

#include <fmt/format.h>

#include <cassert>

namespace tessera {
namespace {

std::string joined(const std::vector<ParameterChoice>& choices) {
  std::string text;
  for (const ParameterChoice& choice : choices) text += (text.empty() ? "" : " ") + std::string(choice.name);
  return text;
}

// Every name of the flags.
std::string words_of(const std::vector<OptionUsage>& options) {
  std::string text;
  for (const OptionUsage& option : options)
    for (const std::string& name : option.names) text += (text.empty() ? "" : " ") + name;
  return text;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// Within single quotes, as bash and zsh have them.
std::string in_quotes(const std::string& text) { return fmt::format("'{}'", replaced(text, "'", "'\\''")); }

// A line that says the text in single quotes to fish, which knows escapes there.
std::string in_fish_quotes(const std::string& text) {
  return fmt::format("'{}'", replaced(replaced(text, "\\", "\\\\"), "'", "\\'"));
}

// bash: words by command, values by flag; files where it knows nothing

constexpr const char* kBash = R"(# Completion of tessera for bash; made by `tessera completion bash`.
_tessera() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} words=
  if [[ $current == = ]]; then
    current=
  elif [[ $previous == = ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  if ((COMP_CWORD == 1)); then
    words=@commands@
  else
    case "${COMP_WORDS[1]} $previous" in
@values@      *)
        case "${COMP_WORDS[1]} $current" in
@flags@        esac
        ;;
    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}
complete -o default -F _tessera tessera
)";

std::string for_bash(const Usage& usage) {
  std::string commands, values, flags;
  for (const CommandUsage& command : usage.commands) {
    commands += command.name + " ";
    for (const OptionUsage& option : command.options)
      for (const std::string& name : option.names)
        if (option.needs_value)
          values +=
              fmt::format("      '{} {}') words={} ;;\n", command.name, name, in_quotes(joined(option.choices)));
    std::string arguments;
    for (const OptionUsage& argument : command.arguments) arguments += joined(argument.choices);
    flags += fmt::format("          {}' '-*) words={} ;;\n", command.name, in_quotes(words_of(command.options)));
    if (!arguments.empty())
      flags += fmt::format("          {}' '*) words={} ;;\n", command.name, in_quotes(arguments));
  }
  std::string script = replaced(kBash, "@commands@", in_quotes(commands + words_of(usage.options)));
  return replaced(replaced(script, "@values@", values), "@flags@", flags);
}

// zsh: _arguments

constexpr const char* kZsh = R"(#compdef tessera
# Completion of tessera for zsh; made by `tessera completion zsh`.
_tessera() {
  local -a commands=(
@commands@  )
  if ((CURRENT == 2)); then
    _describe command commands
    _arguments : @options@
    return
  fi
  local command=$words[2]
  shift words
  ((CURRENT--))
  case $command in
@cases@  esac
}
if [[ $funcstack[1] == _tessera ]]; then
  _tessera "$@"
else
  compdef _tessera tessera
fi
)";

// A text in a specification of _arguments.
std::string zsh_text(std::string text) {
  for (const char* special : {"\\", ":", "[", "]"}) text = replaced(text, special, std::string("\\") + special);
  return text;
}

std::string zsh_value(const OptionUsage& option) {
  const std::string action = option.is_path && option.choices.empty() ? "_files"
                             : option.choices.empty()                 ? " "
                                                                      : fmt::format("({})", joined(option.choices));
  return fmt::format(":{}:{}", zsh_text(option.value.empty() ? option.names.front() : option.value), action);
}

std::string zsh_options(const std::vector<OptionUsage>& options, const std::string& between) {
  std::string text;
  for (const OptionUsage& option : options) {
    for (const std::string& name : option.names) {
      const bool is_long = name.compare(0, 2, "--") == 0;
      const std::string joint = !option.needs_value ? "" : is_long ? "=" : "+";
      const std::string value = option.needs_value ? zsh_value(option) : "";
      text += between + in_quotes(fmt::format("*{}{}[{}]{}", name, joint, zsh_text(option.help), value));
    }
  }
  return text;
}

std::string for_zsh(const Usage& usage) {
  std::string commands, cases;
  for (const CommandUsage& command : usage.commands) {
    commands += fmt::format("    {}\n", in_quotes(command.name + ":" + zsh_text(command.help)));
    cases += fmt::format("    {})\n      _arguments", command.name);
    cases += zsh_options(command.options, " \\\n        ");
    for (const OptionUsage& argument : command.arguments)
      cases += fmt::format(" \\\n        '*{}'", zsh_value(argument));
    cases += " ;;\n";
  }
  const std::string script = replaced(kZsh, "@options@", zsh_options(usage.options, " "));
  return replaced(replaced(script, "@commands@", commands), "@cases@", cases);
}

// fish: a line for each flag

std::string fish_option(const std::string& condition, const OptionUsage& option) {
  std::string line = "complete -c tessera -n " + in_fish_quotes(condition);
  for (const std::string& name : option.names)
    line += name.compare(0, 2, "--") == 0 ? " -l " + name.substr(2) : " -s " + name.substr(1);
  std::string choices;
  for (const ParameterChoice& choice : option.choices)
    choices += fmt::format("{}{}\\t{}", choices.empty() ? "" : "\n", choice.name, in_fish_quotes(choice.help));
  if (option.needs_value) line += option.is_path && choices.empty() ? " -r -F" : " -x";
  if (!choices.empty()) line += " -a " + in_fish_quotes(choices);
  return line + " -d " + in_fish_quotes(option.help) + "\n";
}

std::string for_fish(const Usage& usage) {
  std::string text = "# Completion of tessera for fish; made by `tessera completion fish`.\n";
  for (const OptionUsage& option : usage.options) text += fish_option("__fish_use_subcommand", option);
  for (const CommandUsage& command : usage.commands) {
    text += fmt::format("complete -c tessera -n __fish_use_subcommand -f -a {} -d {}\n", command.name,
                        in_fish_quotes(command.help));
    const std::string condition = "__fish_seen_subcommand_from " + command.name;
    for (const OptionUsage& option : command.options) text += fish_option(condition, option);
    for (const OptionUsage& argument : command.arguments)
      if (!argument.choices.empty())
        text += fmt::format("complete -c tessera -n {} -f -a {}\n", in_fish_quotes(condition),
                            in_fish_quotes(joined(argument.choices)));
  }
  return text;
}

}  // namespace

std::string completion_script(std::string_view shell, const Usage& usage) {
  if (shell == "bash") return for_bash(usage);
  if (shell == "zsh") return for_zsh(usage);
  assert(shell == "fish");
  return for_fish(usage);
}

}  // namespace tessera
