// What the program can be told, as data: the man page and the completions of shells are made of it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tessera/job/parameters.h"

namespace tessera {

struct OptionUsage {
  std::vector<std::string> names;        // "-o", "--output"; of an argument without a flag its name alone, "DRAWING"
  std::string value;                     // what follows it, as help shows it: "FILE"; empty: nothing
  std::string help;                      // one line
  std::string group;                     // heading in the help
  std::vector<ParameterChoice> choices;  // values it takes; empty: others
  bool needs_value = false;              // false also where the value may be left out
  bool is_path = false;
  bool is_required = false;
};

struct CommandUsage {
  std::string name;                    // "pave"
  std::string help;                    // one line
  std::vector<OptionUsage> arguments;  // in their order
  std::vector<OptionUsage> options;
  std::string footer;  // lines; without what is said of every command
};

struct Usage {
  std::string help;
  std::vector<OptionUsage> options;  // of the program itself
  std::vector<CommandUsage> commands;
};

// What every command's help says of pictures, and of exit statuses.
inline constexpr const char* kPicturesHelp = "Pictures are PNG, JPEG, WebP, TIFF or BMP; - is standard input.";
inline constexpr const char* kExitStatusHelp =
    "0 done, 1 a fault of ours, 2 wrong usage or parameter, 3 an input that cannot be used, 4 an output that\n"
    "cannot be written, 124 out of time, 130 interrupted.";
std::string inputs_footer();

// bash, zsh, fish: what completion_script() (shells.h) is for.
std::vector<ParameterChoice> shells();

// Flags, arguments and their help come from `app`, the values that can be chosen from the parameters' description.
Usage usage_of(const CLI::App& app);

}  // namespace tessera
