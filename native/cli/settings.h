// What the user wants of a run beyond the job itself.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tessera/cli/backend.h"
#include "tessera/cli/progress.h"
#include "tessera/job/parameters.h"

namespace tessera {

// A file to write; "-" is standard output.
struct OutputFile {
  std::string path;
  std::string format;  // empty: its name says it
};

struct Settings {
  std::vector<OutputFile> outputs;
  std::string format;    // of outputs whose name has no extension, as "-"
  std::string report;    // path; empty: none
  std::string save_job;  // path; empty: none
  std::string plots;     // folder; empty: none
  std::optional<std::uint64_t> seed;
  BackendChoice backend = BackendChoice::kAuto;
  int threads = 0;  // 0: all
  ProgressMode progress = ProgressMode::kAuto;
  bool quiet = false;
  std::uint64_t max_pixels = 0;
  double timeout_s = 0;  // 0: none
  double png_scale = 0;  // 0: the sheet's size decides
  double improve_s = 0;  // 0: as the job says
  bool resume = false;
};

// The flags of Settings that take a number or a word, described as parameters are.
std::vector<Parameter> setting_flags();
// Takes what was given of them; adds every problem there is.
void read_settings(const Json& given, Settings& settings, Problems& problems);

}  // namespace tessera
