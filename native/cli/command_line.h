// The arguments of the program, as what is to be done.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <variant>
#include <vector>

#include "tessera/cli/batch_command.h"
#include "tessera/cli/fit_command.h"
#include "tessera/cli/measure_command.h"
#include "tessera/cli/settings.h"
#include "tessera/cli/view_command.h"
#include "tessera/job/job.h"
#include "tessera/job/techniques.h"

namespace tessera {

// `tessera pave DRAWING --half-side 6 -o stones.svg`
struct RunNewJob {
  Job job;
  Settings settings;
};

// `tessera parquet TARGET --plan`
struct AskJob {
  Job job;
  const Question* question;
  Settings settings;
};

// `tessera run job.json --set halfSide=6 -o stones.svg`
struct RunSavedJob {
  std::string path;
  std::vector<std::string> changes;  // "key=value"
  Settings settings;
};

// `tessera schema pavement`
struct PrintSchema {
  std::string technique;  // empty: that of a job
  bool markdown = false;
};

// `tessera pattern --list`
struct PrintText {
  std::string text;
};

using Command =
    std::variant<RunNewJob, AskJob, RunSavedJob, Batch, Measure, FitCommand, View, PrintSchema, PrintText>;

// What is to be done; else the exit status, when everything has been said already: help, version, wrong usage.
tl::expected<Command, int> parse_command_line(int argc, const char* const* argv);

}  // namespace tessera
