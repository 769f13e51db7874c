// `tessera measure`
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tessera/base/status.h"

namespace tessera {

struct Measure {
  std::string path;
  std::string model;  // empty: none
  double lambda = 0;
  std::vector<double> distances;
  std::vector<double> window;  // width, height; or empty
  int needles = 40000;
  int colors = 0;
  std::uint64_t seed = 1;
  std::uint64_t max_pixels = 0;
  std::vector<std::string> outputs;  // .json, .csv
  std::string report, plots;
};

// The flags of the command, which `measure` is filled from as it parses.
CLI::App& add_measure_command(CLI::App& app, Measure& measure);
// Measures and writes; the exit status.
int run_measure(const Measure& measure);

}  // namespace tessera
