// The techniques there are: what each is called, what it reads and how it is run.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tessera/job/job.h"

namespace tessera {

struct InputRole {
  std::string_view name;  // "drawing"
  std::string_view help;  // one line
  bool required = true;
  // A name that is none of this parameter's choices is a file in this role, and the parameter `chosen`.
  std::string_view parameter{}, chosen{};
  bool many = false;     // any number of pictures, each with a name: the role "panel" has "panel-oak", "panel-walnut"
  bool numbers = false;  // pixels are numbers rather than colours: 16-bit grey comes as (0, high, low) byte
  bool shapes = false;   // an SVG will do as well: read_shapes() makes the picture of it
};

// Something that can be asked of a job before it is run: `tessera parquet --plan`.
struct Question {
  std::string_view name;                 // "plan"
  std::string_view help;                 // one line
  std::vector<std::string_view> inputs;  // the roles that it looks at; others need not be there
  Result<std::string> (*answer)(const Job& job, const Pictures& pictures,
                                const RunContext& context);  // lines of text
};

using TechniqueRun = Result<Outcome>(const Job& job, const Pictures& pictures, Rasterizer& rasterizer,
                                     const RunContext& context, const IterationObserver& observer);

struct Technique {
  std::string_view name;     // "pavement", of the job
  std::string_view command;  // "pave", of the command line
  std::string_view help;     // one line
  std::vector<InputRole> inputs;
  std::vector<std::string> formats;  // of JobRequest
  TechniqueParams defaults;
  std::string_view subject{};  // the parameter that the command line takes in the place of a picture
  std::vector<Question> questions{};
  bool long_running = false;  // may be stopped and go on, and improve its result (RunContext)
  TechniqueRun* run;          // pictures hold every required role, the parameters are valid
};

// In the order of TechniqueParams' alternatives.
const std::vector<Technique>& techniques();
const Technique& technique_of(const TechniqueParams& params);
const Technique* find_technique(std::string_view name);  // by name; null: there is none

// What an input of a job is: "target", "panel-oak". Null: the technique has no such role.
const InputRole* role_of(const Technique& technique, std::string_view input);
// "target, panel-NAME or mask-NAME"
std::string role_names(const Technique& technique);
// "oak" of "panel-oak"
std::string_view name_in(const InputRole& role, std::string_view input);

// The picture in that role; without pixels where there is none.
ImageView picture_of(const Pictures& pictures, std::string_view role);

}  // namespace tessera
