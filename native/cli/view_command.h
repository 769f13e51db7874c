// `tessera view`
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tessera/cli/flags.h"
#include "tessera/cli/settings.h"

namespace tessera {

struct View {
  std::string path;
  std::vector<std::string> changes;  // "key=value", of a job
  std::vector<int> size{1280, 800};  // of the window
  std::string screenshot;            // path; empty: a name of ours
  bool ends = false;                 // once the result has been shown
  Settings settings;                 // of the job's run
};

class ViewFlags {
 public:
  explicit ViewFlags(CLI::App& app);

  bool chosen() const { return app_.parsed(); }
  View read(Problems& problems) const;

 private:
  CLI::App& app_;
  View view_;
  ParameterFlags settings_;
};

// Shows the file in a window until that is closed; a job is run meanwhile. The exit status; problems have been
// printed.
int run_view(const View& view);

}  // namespace tessera
