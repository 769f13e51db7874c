// What a long run has done so far, in a file.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "tessera/base/status.h"

namespace tessera {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class Checkpoint {
 public:
  explicit Checkpoint(std::string path = "") : path_(std::move(path)) {}

  const std::string& path() const { return path_; }        // empty: there is none
  const std::string& earlier() const { return earlier_; }  // what read() found
  const std::string& kept() const { return kept_; }        // where the state is now; empty: nowhere

  // Takes an earlier run's state from the file; none where there is no such file.
  Result<void> read();
  // Writes the state every ten seconds, and once the run has been told to stop. A file that cannot be written is no
  // reason to stop.
  void offer(const std::function<std::string()>& state);

 private:
  std::string path_, earlier_, kept_;
  Stopwatch since_written_;
};

}  // namespace tessera
