#include "tessera/cli/man_page.h"

#include <fmt/format.h>

#include <string_view>

#include "tessera/cli/flags.h"

namespace tessera {
namespace {

constexpr const char* kExamples[][2] = {
    {"Stones of a drawing, as SVG and DXF, and the job that makes them again:",
     "tessera pave waves.png --half-side 6 -o stones.svg -o stones.dxf --save-job job.json"},
    {"The same with wider grout:", "tessera run job.json --set grout=1 -o stones.png"},
    {"Tiles along the contours of a photo:", "tessera mosaic photo.jpg -o tiles.svg"},
    {"Random cells:", "tessera pattern occupancy --seed 7 -o cells.svg"},
};

// Text as roff takes it: no character of it is a request, a hyphen is what one types.
std::string roff(std::string_view text) {
  std::string escaped;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
    at_start = c == '\n';
  }
  return escaped;
}

std::string bold(std::string_view text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(std::string_view text) { return "\\fI" + roff(text) + "\\fR"; }

std::string heading(std::string_view text) { return fmt::format(".SH \"{}\"\n", roff(text)); }

// "\fB-o\fR, \fB--output\fR \fIFILE\fR"
std::string option_entry(const OptionUsage& option) {
  std::string names;
  for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) names += " " + italic(option.value);
  return fmt::format(".TP\n{}\n{}\n", names, roff(option.help));
}

std::string arguments_of(const CommandUsage& command) {
  std::string text;
  for (const OptionUsage& argument : command.arguments) {
    const std::string name = italic(argument.names.front());
    text += argument.is_required ? " " + name : fmt::format(" [{}]", name);
  }
  return text;
}

std::string synopsis_of(const CommandUsage& command) {
  return fmt::format("{}{} [{}...]\n", bold("tessera " + command.name), arguments_of(command), italic("OPTION"));
}

std::string command_section(const CommandUsage& command) {
  std::string text = heading("TESSERA " + upper_case(command.name));
  text += synopsis_of(command) + fmt::format(".PP\n{}.\n", roff(command.help));
  for (const OptionUsage& argument : command.arguments)
    text += fmt::format(".TP\n{}\n{}\n", italic(argument.names.front()), roff(argument.help));
  std::string group;
  for (const OptionUsage& option : command.options) {
    if (option.names.back() == "--help") continue;  // every command has it
    if (option.group != group) text += fmt::format(".SS \"{}\"\n", roff(option.group));
    group = option.group;
    text += option_entry(option);
  }
  if (!command.footer.empty())
    text += ".SS \"Notes\"\n" + roff(command.footer) + (command.footer.back() == '\n' ? "" : "\n");
  return text;
}

}  // namespace

std::string man_page(const Usage& usage) {
  std::string text =
      fmt::format(".\\\" Made by `tessera schema --man`.\n.TH TESSERA 1 \"\" \"tessera {}\" \"User Commands\"\n",
                  TESSERA_VERSION);
  text += heading("NAME") + "tessera \\- turns pictures into pieces\n";
  text += heading("SYNOPSIS");
  for (const CommandUsage& command : usage.commands) {
    if (&command != usage.commands.data()) text += ".br\n";
    text += synopsis_of(command);
  }
  text += heading("DESCRIPTION") + roff(usage.help) + "\n" + roff(kPicturesHelp) + "\n";
  for (const OptionUsage& option : usage.options) text += option_entry(option);
  for (const CommandUsage& command : usage.commands) text += command_section(command);
  text += heading("EXIT STATUS") + roff(kExitStatusHelp) + "\n";
  text += heading("EXAMPLES");
  for (const auto& [what, line] : kExamples) text += fmt::format(".TP\n{}\n{}\n", roff(what), bold(line));
  return text;
}

}  // namespace tessera
