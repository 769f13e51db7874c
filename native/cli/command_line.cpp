#include "tessera/cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <list>
#include <map>
#include <optional>
#include <set>

#include "tessera/cli/flags.h"
#include "tessera/cli/man_page.h"
#include "tessera/cli/messages.h"
#include "tessera/cli/panel_flags.h"
#include "tessera/cli/shells.h"
#include "tessera/cli/usage.h"
#include "tessera/job/techniques.h"

namespace tessera {
namespace {

constexpr const char* kJobFooter =
    "A relative path of a picture in the job is looked for beside the job's file first, then in the current "
    "folder.\n";

// The flags that every command shares which runs a job.
class SettingFlags {
 public:
  SettingFlags(CLI::App& command, const std::vector<std::string>& formats, bool long_running)
      : common_(command, kGroup, setting_flags()) {
    const auto add = [&](const char* flags, auto& target, const char* type, const std::string& help) {
      return command.add_option(flags, target, help)->type_name(type)->group(kGroup);
    };
    std::vector<std::string> extensions;
    for (const std::string& format : formats) extensions.push_back("." + format);
    const std::string kinds = extensions.empty() ? "" : ": " + either_of(extensions);
    add("-o,--output", paths_, "FILE",
        "Where the result goes, its kind follows the extension" + kinds +
            "; several are allowed, - is standard output")
        ->allow_extra_args(false)
        ->take_all();
    // "labels.png" may also be asked for by name, whatever the file is called.
    for (const std::string& format : formats)
      if (const std::size_t dot = format.find('.'); dot != std::string::npos)
        add(("--" + format.substr(0, dot)).c_str(), named_[format], "FILE", "The same as -o FILE." + format);
    if (std::find(formats.begin(), formats.end(), "apng") != formats.end())
      add("--animate", named_["apng"], "FILE", "An animated PNG of the iterations; the same as -o FILE.apng");
    add("--format", settings_.format, "KIND", "Kind of an output whose name has no extension, as -");
    add("--report", settings_.report, "FILE", "Write times, counts and checksums as JSON");
    add("--save-job", settings_.save_job, "FILE", "Write the job as JSON, for tessera run");
    add("--plots", settings_.plots, "FOLDER", "Write histograms and curves as SVG");
    command.add_flag("--quiet", settings_.quiet, "Neither bar nor warnings")->group(kGroup);
    if (!long_running) return;
    add("--improve", settings_.improve_s, "SECONDS", "Go on making the result better for so long")
        ->check(CLI::Range(0.001, 1e8));
    command.add_flag("--resume", settings_.resume, "Go on where an interrupted run stopped (FOLDER.checkpoint)")
        ->group(kGroup);
  }

  Settings read(Problems& problems) const {
    Settings settings = settings_;
    for (const std::string& path : paths_) settings.outputs.push_back({path, ""});
    for (const auto& [format, path] : named_)
      if (!path.empty()) settings.outputs.push_back({path, format});
    read_settings(common_.given(), settings, problems);
    return settings;
  }

  void name_flags(Problems& problems) const { common_.name_flags(problems); }

 private:
  static constexpr const char* kGroup = "Run";
  Settings settings_;
  std::vector<std::string> paths_;
  std::map<std::string, std::string> named_;  // format -> path
  ParameterFlags common_;
};

std::vector<Parameter> select(const std::vector<Parameter>& all, bool advanced) {
  std::vector<Parameter> selected;
  for (const Parameter& parameter : all) {
    if (parameter.info.advanced == advanced) selected.push_back(parameter);
  }
  return selected;
}

// `tessera pave`: a technique with its inputs and parameters.
class TechniqueCommand {
 public:
  TechniqueCommand(CLI::App& app, const Technique& technique)
      : technique_(technique),
        app_(*app.add_subcommand(std::string(technique.command), std::string(technique.help))),
        main_(app_, "Parameters", select(parameters_of(technique.defaults), false)),
        advanced_(app_, "More parameters", select(parameters_of(technique.defaults), true)),
        run_(app_, technique.formats, technique.long_running) {
    for (const InputRole& role : technique.inputs) {
      const std::string name(role.name);
      if (role.many) continue;
      if (is_many(name)) {
        app_.add_option(upper_case(role.name), many_[name], std::string(role.help))->required()->type_name("FILE");
        continue;
      }
      std::string& path = inputs_[name];
      if (role.required) {
        app_.add_option(upper_case(role.name), path, std::string(role.help))->required()->type_name("FILE");
      } else {
        app_.add_option("--" + name, path, std::string(role.help))->type_name("FILE")->group("Inputs");
      }
    }
    if (find_role("panel")) {
      app_.add_option("--panel", panels_, "A scan of veneer; several are allowed")
          ->type_name("SCAN[,mask=FILE,dpi=N,name=WORD,margin=MM,machine=X:Y,...]")
          ->allow_extra_args(false)
          ->take_all()
          ->group("Inputs");
    }
    for (const Question& question : technique.questions)
      app_.add_flag("--" + std::string(question.name), asked_[question.name], std::string(question.help))
          ->group("Run");
    if (!technique.subject.empty()) {
      app_.add_option(upper_case(technique.subject), subject_, "What to make; --list names them")->type_name("NAME");
      app_.add_flag("--list", list_, "Print the names and what they are")->group("Run");
    }
    app_.footer(inputs_footer());
  }

  bool chosen() const { return app_.parsed(); }

  Command read(Problems& problems) const {
    if (list_) return PrintText{subjects()};
    RunNewJob command;
    command.settings = run_.read(problems);
    command.job.inputs = inputs_;
    std::erase_if(command.job.inputs, [](const auto& input) { return input.second.empty(); });
    for (const auto& [name, paths] : many_)  // target, target-2, target-3
      for (std::size_t i = 0; i < paths.size(); ++i)
        command.job.inputs[i == 0 ? name : fmt::format("{}-{}", name, i + 1)] = paths[i];
    command.job.params = technique_.defaults;
    Json given = main_.given();
    given.update(advanced_.given());
    take_subject(given, problems);
    take_panels(given, command.job, problems);
    take_file(given, command.job);
    read_params(given, command.job.params, problems);
    for (const ParameterFlags* flags : {&main_, &advanced_}) flags->name_flags(problems);
    run_.name_flags(problems);
    for (const Question& question : technique_.questions)
      if (asked_.at(question.name)) return AskJob{command.job, &question, command.settings};
    if (find_role("panel") && panels_.empty() && problems.empty())
      problems.push_back({StatusCode::kInvalidParameter, "", "there is no panel, expected --panel SCAN"});
    return command;
  }

 private:
  const InputRole* find_role(std::string_view name) const {
    for (const InputRole& role : technique_.inputs)
      if (role.name == name) return &role;
    return nullptr;
  }

  // Whether a role takes one picture and then more with names.
  bool is_many(std::string_view name) const {
    return std::any_of(technique_.inputs.begin(), technique_.inputs.end(),
                       [&](const InputRole& role) { return role.many && role.name == name; });
  }

  void take_panels(Json& given, Job& job, Problems& problems) const {
    if (panels_.empty()) return;
    std::string options = given.value("panels", "");
    tessera::take_panels(panels_, job, options, problems);
    if (!options.empty()) given["panels"] = options;
  }

  // "occupancy  each place goes to the nearest point", a line each.
  std::string subjects() const {
    std::string text;
    for (const Parameter& parameter : parameters_of(technique_.defaults)) {
      if (parameter.info.key != technique_.subject) continue;
      for (const ParameterChoice& choice : parameter.choices)
        text += fmt::format("{:<16}{}\n", choice.name, choice.help);
    }
    return text;
  }

  // `tessera pattern occupancy`
  void take_subject(Json& given, Problems& problems) const {
    const std::string key(technique_.subject);
    if (key.empty() || given.contains(key)) return;
    if (subject_.empty())
      problems.push_back({StatusCode::kInvalidParameter, key, "is missing, expected a name (see --list)"});
    else
      given[key] = subject_;
  }

  // "--segmenter FILE": what is none of the choices is an input's path.
  void take_file(Json& given, Job& job) const {
    const std::vector<Parameter> parameters = parameters_of(technique_.defaults);
    for (const InputRole& role : technique_.inputs) {
      const auto value = given.find(std::string(role.parameter));
      if (role.parameter.empty() || value == given.end()) continue;
      const auto parameter = std::find_if(parameters.begin(), parameters.end(),
                                          [&](const Parameter& p) { return p.info.key == role.parameter; });
      const std::string text = value->get<std::string>();
      if (!complaint(*parameter, *value) || !std::filesystem::exists(text)) continue;
      job.inputs[std::string(role.name)] = text;
      *value = std::string(role.chosen);
    }
  }

  const Technique& technique_;
  CLI::App& app_;
  std::map<std::string, std::string> inputs_;
  std::map<std::string, std::vector<std::string>> many_;
  std::vector<std::string> panels_;
  std::map<std::string_view, bool> asked_;  // question -> whether it is
  std::string subject_;
  bool list_ = false;
  ParameterFlags main_, advanced_;
  SettingFlags run_;
};

// `tessera run`
class SavedJobCommand {
 public:
  explicit SavedJobCommand(CLI::App& app)
      : app_(*app.add_subcommand("run", "Run a saved job again, or the job inside an SVG")), run_(app_, {}, true) {
    app_.add_option("JOB", command_.path, "A job's JSON, or an SVG that tessera made")->required()->type_name("FILE");
    app_.add_option("--set", command_.changes, "Change a parameter, an input or the seed")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->take_all();
    app_.footer(kJobFooter + inputs_footer());
  }

  bool chosen() const { return app_.parsed(); }

  RunSavedJob read(Problems& problems) const {
    RunSavedJob command = command_;
    command.settings = run_.read(problems);
    run_.name_flags(problems);
    return command;
  }

 private:
  CLI::App& app_;
  RunSavedJob command_;
  SettingFlags run_;
};

// `tessera schema`
class SchemaCommand {
 public:
  explicit SchemaCommand(CLI::App& app)
      : app_(*app.add_subcommand("schema", "Print the parameters as JSON Schema, as Markdown or as a man page")) {
    app_.add_option("TECHNIQUE", command_.technique, "Its parameters only")->type_name("NAME");
    app_.add_flag("--markdown", command_.markdown, "The reference of all parameters");
    app_.add_flag("--man", man_, "The man page of all commands");
  }

  bool chosen() const { return app_.parsed(); }
  Command read(const Usage& usage) const {
    if (man_) return PrintText{man_page(usage)};
    return command_;
  }

 private:
  CLI::App& app_;
  PrintSchema command_;
  bool man_ = false;
};

// `tessera completion`
class CompletionCommand {
 public:
  explicit CompletionCommand(CLI::App& app)
      : app_(*app.add_subcommand("completion", "Print a script that completes commands and flags in a shell")) {
    app_.add_option("SHELL", shell_, "bash, zsh or fish")->required()->type_name("NAME");
    app_.footer("For this session: source <(tessera completion bash)");
  }

  bool chosen() const { return app_.parsed(); }
  Command read(const Usage& usage, Problems& problems) const {
    std::vector<std::string> names;
    for (const ParameterChoice& shell : shells()) {
      if (shell_ == shell.name) return PrintText{completion_script(shell_, usage)};
      names.emplace_back(shell.name);
    }
    problems.push_back(
        {StatusCode::kInvalidParameter, "SHELL", "is " + shown(shell_) + ", expected " + either_of(names)});
    return PrintText{};
  }

 private:
  CLI::App& app_;
  std::string shell_;
};

bool is_number(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// "--ground" is "--ground=true" where neither true nor false follows; `pave --tiles` is "--tiles=2048" where no
// number does.
std::vector<std::string> with_flag_values(int argc, const char* const* argv) {
  std::set<std::string> flags;
  std::map<std::string, std::string> bare;  // of the command's
  for (const Technique& technique : techniques()) {
    for (const Parameter& parameter : parameters_of(technique.defaults)) {
      if (parameter.kind == ParameterKind::kFlag) flags.insert(flag_of(parameter));
      if (argc > 1 && technique.command == argv[1] && *parameter.info.bare)
        bare[flag_of(parameter)] = parameter.info.bare;
    }
  }
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string_view next = i + 1 < argc ? argv[i + 1] : "";
    std::string argument = argv[i];
    if (flags.count(argument) != 0 && next != "true" && next != "false") argument += "=true";
    if (const auto value = bare.find(argument); value != bare.end() && !is_number(next))
      argument += "=" + value->second;
    arguments.push_back(std::move(argument));
  }
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
  return arguments;
}

Status no_command(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return {StatusCode::kInvalidParameter, "", "there is no command, expected " + either_of(names) + " (see --help)"};
}

}  // namespace

tl::expected<Command, int> parse_command_line(int argc, const char* const* argv) {
  CLI::App app("Tessera turns pictures into pieces.", "tessera");
  app.set_version_flag("--version", "tessera " TESSERA_VERSION);
  app.get_formatter()->column_width(28);
  app.require_subcommand(0, 1);
  std::list<TechniqueCommand> makers;
  for (const Technique& technique : techniques()) makers.emplace_back(app, technique);
  Measure measure;
  const CLI::App& measuring = add_measure_command(app, measure);
  FitCommand fit;
  const CLI::App& fitting = add_fit_command(app, fit);
  const SavedJobCommand run(app);
  const BatchFlags batch(app);
  const ViewFlags view(app);
  const SchemaCommand schema(app);
  const CompletionCommand completion(app);

  try {
    app.parse(with_flag_values(argc, argv));
  } catch (const CLI::Success& done) {
    return tl::unexpected<int>(app.exit(done));
  } catch (const CLI::ParseError& error) {
    print_message(std::string(error.what()) + " (see --help)");
    return tl::unexpected<int>(kExitUsage);
  }

  Problems problems;
  std::optional<Command> command;
  for (const TechniqueCommand& maker : makers) {
    if (maker.chosen()) command = maker.read(problems);
  }
  if (measuring.parsed()) command = measure;
  if (fitting.parsed()) command = fit;
  if (run.chosen()) command = run.read(problems);
  if (batch.chosen()) command = batch.read(problems);
  if (view.chosen()) command = view.read(problems);
  if (schema.chosen()) command = schema.read(usage_of(app));
  if (completion.chosen()) command = completion.read(usage_of(app), problems);
  if (!command) problems.push_back(no_command(app));
  if (!problems.empty()) return tl::unexpected<int>(print_problems(problems));
  return *std::move(command);
}

}  // namespace tessera
