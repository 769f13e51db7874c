// The vocabulary in which a technique describes its parameters, once.
//
// A technique has a plain struct whose member initialisers are the defaults, and a function
//
//   template <class Visitor> void visit(Visitor& visitor, PavementParams& params) {
//     visitor.number(params.half_side, {.key = "halfSide", .min = 1, .max = 256, ...});
//     visitor.choice(params.method, {.key = "method", ...}, {{Method::kFlow, "flow", "..."}, ...});
//   }
//
// A visitor has the members number(double&), integer(int&), flag(bool&), text(std::string&), each with a
// ParameterInfo, and choice(Enum&, ParameterInfo, std::initializer_list<Choice<Enum>>). From it come the JSON of a
// job, the checks, the command line's flags, the web form, the JSON Schema and docs/parameters.md.
#pragma once

#include <limits>

namespace tessera {

// Strings are literals. `key` is camelCase; the flag is the same word in kebab-case.
struct ParameterInfo {
  const char* key = "";
  double min = -std::numeric_limits<double>::infinity();  // hard range, both ends allowed
  double max = std::numeric_limits<double>::infinity();
  double ui_min = min;  // what a slider spans
  double ui_max = max;
  const char* unit = "";    // "px", "deg", "mm", "" for a plain number
  const char* help = "";    // one line
  const char* symbol = "";  // the paper's
  bool advanced = false;    // folded away in the form
  const char* bare = "";    // what the flag alone means, without a value; "": it needs one
};

template <class Enum>
struct Choice {
  Enum value;
  const char* name;
  const char* help;
};

}  // namespace tessera
