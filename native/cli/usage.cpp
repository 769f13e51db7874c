#include "tessera/cli/usage.h"

#include <map>
#include <utility>

#include "tessera/cli/flags.h"
#include "tessera/cli/settings.h"
#include "tessera/job/techniques.h"

namespace tessera {
namespace {

// Parameters by the name that stands for them on the command line.
using ByName = std::map<std::string, Parameter>;

Parameter choice_of(std::vector<ParameterChoice> choices) {
  return {{}, ParameterKind::kChoice, nullptr, std::move(choices)};
}

ByName parameters_of_command(const std::string& command) {
  ByName named;
  for (const Parameter& parameter : setting_flags()) named[flag_of(parameter)] = parameter;
  std::vector<ParameterChoice> names;
  for (const Technique& technique : techniques()) {
    names.push_back({technique.name.data(), technique.help.data()});
    if (technique.command != command) continue;
    for (const Parameter& parameter : parameters_of(technique.defaults)) {
      named[flag_of(parameter)] = parameter;
      if (parameter.info.key == technique.subject) named[upper_case(technique.subject)] = parameter;
    }
  }
  named["TECHNIQUE"] = choice_of(std::move(names));
  named["SHELL"] = choice_of(shells());
  return named;
}

bool names_path(const std::string& type) {
  return type.find("FILE") != std::string::npos || type.find("FOLDER") != std::string::npos ||
         type.find("SCAN") != std::string::npos;
}

OptionUsage option_usage(const CLI::Option& option, const ByName& parameters) {
  OptionUsage usage;
  for (const std::string& name : option.get_snames()) usage.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) usage.names.push_back("--" + name);
  if (usage.names.empty()) usage.names.push_back(option.get_single_name());
  usage.needs_value = option.get_items_expected_max() > 0;
  if (usage.needs_value) usage.value = option.get_type_name();
  usage.help = option.get_description();
  usage.group = option.get_group();
  usage.is_required = option.get_required();
  usage.is_path = names_path(usage.value);
  if (const auto found = parameters.find(usage.names.back()); found != parameters.end()) {
    usage.choices = found->second.choices;
    usage.needs_value = found->second.kind != ParameterKind::kFlag;
  }
  return usage;
}

std::string own_footer(const CLI::App& command) {
  std::string text = command.get_footer();
  const std::string common = inputs_footer();
  if (text.size() >= common.size() && text.compare(text.size() - common.size(), common.size(), common) == 0)
    text.resize(text.size() - common.size());
  return text;
}

CommandUsage command_usage(const CLI::App& command) {
  CommandUsage usage{command.get_name(), command.get_description(), {}, {}, own_footer(command)};
  const ByName parameters = parameters_of_command(usage.name);
  for (const CLI::Option* option : command.get_options())
    (option->get_positional() ? usage.arguments : usage.options).push_back(option_usage(*option, parameters));
  return usage;
}

}  // namespace

std::string inputs_footer() { return std::string(kPicturesHelp) + "\nExit status: " + kExitStatusHelp; }

std::vector<ParameterChoice> shells() { return {{"bash", ""}, {"zsh", ""}, {"fish", ""}}; }

Usage usage_of(const CLI::App& app) {
  Usage usage{app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) usage.options.push_back(option_usage(*option, {}));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    usage.commands.push_back(command_usage(*command));
  return usage;
}

}  // namespace tessera
