// Descriptions of parameters as flags of the command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tessera/job/parameters.h"

namespace tessera {

// "--half-side"
std::string flag_of(const Parameter& parameter);
// "DRAWING" of "drawing", as the arguments without a flag are named
std::string upper_case(std::string_view text);
// A typed text as the JSON value that the parameter expects; as a string where it is none, which is refused later
// with everything else that is wrong.
Json parse_value(const Parameter& parameter, const std::string& text);

// One flag a parameter, with its unit, range and default in the help.
class ParameterFlags {
 public:
  // `command` writes into this object as it parses.
  ParameterFlags(CLI::App& command, const std::string& group, std::vector<Parameter> parameters);
  ParameterFlags(const ParameterFlags&) = delete;
  ParameterFlags& operator=(const ParameterFlags&) = delete;

  // What was given: {"halfSide": 6}.
  Json given() const;
  // Appends the flag to what is said of a parameter that is one of these: "... (--half-side)".
  void name_flags(Problems& problems) const;

 private:
  struct Flag {
    Parameter parameter;
    std::string text;
    CLI::Option* option = nullptr;
  };
  std::vector<Flag> flags_;
};

}  // namespace tessera
