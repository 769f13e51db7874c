// `tessera batch`
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "tessera/cli/flags.h"
#include "tessera/cli/settings.h"

namespace tessera {

struct Batch {
  std::string path;     // of the jobs, one a line
  std::string results;  // path; empty: beside the jobs
  int shard = 1, shards = 1;
  int workers = 1;
  bool resume = false;
  Settings settings;  // of each job, but for its outputs
};

class BatchFlags {
 public:
  explicit BatchFlags(CLI::App& app);

  bool chosen() const { return app_.parsed(); }
  Batch read(Problems& problems) const;

 private:
  CLI::App& app_;
  Batch batch_;
  std::string shard_;
  ParameterFlags settings_;
};

// Runs the jobs, each in a process of its own, so that none takes the others with it. The exit status: that of the
// first line that failed.
int run_batch(const Batch& batch);

}  // namespace tessera
