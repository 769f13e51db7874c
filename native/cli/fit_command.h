// `tessera fit`
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

namespace tessera {

struct FitCommand {
  std::string path;
  std::string output;  // the job; empty: none
  std::string report;  // empty: standard output where there is no output either
  std::uint64_t seed = 1;
  std::uint64_t max_pixels = 100'000'000;
};

// The flags of the command, which `fit` is filled from as it parses.
CLI::App& add_fit_command(CLI::App& app, FitCommand& fit);
// Fits and writes; the exit status.
int run_fit(const FitCommand& command);

}  // namespace tessera
