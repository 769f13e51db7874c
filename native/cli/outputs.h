// Where the results of a run go.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tessera/cli/settings.h"
#include "tessera/io/atomic_file.h"
#include "tessera/job/job.h"

namespace tessera {

// The kinds that the outputs ask for, one a path and in their order. Adds a problem for each path without a kind that
// the job's technique has, for a path named twice, and where there is no output at all.
std::vector<std::string> plan_formats(const Settings& settings, const Job& job, Problems& problems);

struct WrittenFile {
  std::string path;
  std::size_t bytes = 0;
  std::string sha256;  // empty where it was not asked for
};

// Where the report goes: where the settings say, and into each folder. `formats` are those of plan_formats().
std::vector<std::string> report_paths(const Settings& settings, const std::vector<std::string>& formats);

// Where a run whose first output is a folder keeps what it has done so far: beside that, FOLDER.checkpoint. Empty:
// nowhere.
std::string checkpoint_path(const Settings& settings, const std::vector<std::string>& formats);

// Hands everything but the report to `files`, in the order: outputs, plots, job. Cut files that an earlier run has
// left in a folder go.
Result<std::vector<WrittenFile>> write_outputs(const Settings& settings, const std::vector<std::string>& formats,
                                               const Job& job, const JobResult& result, AtomicFiles& files);

// The job where the settings want it, as the last part of that.
Result<void> save_job(const Settings& settings, const Job& job, AtomicFiles& files,
                      std::vector<WrittenFile>& written);

}  // namespace tessera
