// A job from its pictures to its files.
#pragma once

#include <string>

#include "tessera/cli/settings.h"
#include "tessera/job/job.h"
#include "tessera/job/techniques.h"

namespace tessera {

// Threads and the time limit of this process.
void prepare(const Settings& settings);

// Where a person changes the job's parameters.
enum class ParametersFrom { kFlags, kFile };

// Runs the job and writes what the settings ask for; relative inputs are looked for in `folder` first (empty: none).
// The exit status; problems have been printed, and nothing is left behind by a run that failed.
int run_and_write(Job job, const Settings& settings, const std::string& folder, ParametersFrom from);

// What the technique says of the job before it is run, as text.
tl::expected<std::string, Problems> ask_job(Job job, const Question& question, const Settings& settings);

}  // namespace tessera
