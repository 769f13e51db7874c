// How long each stage of a run takes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tessera {

struct StageTime {
  std::string name;
  double ms = 0;      // on the wall
  double cpu_ms = 0;  // of all threads
};

class StageClock {
 public:
  StageClock();

  // A stage lasts until the next one; begun again, it goes on from where it was.
  void begin(std::string_view name);
  void end();

  const std::vector<StageTime>& stages() const { return stages_; }
  double total_ms() const;  // since the clock was made

 private:
  struct Reading {
    double ms, cpu_ms;
  };
  static Reading read();

  Reading start_;
  Reading stage_start_{};
  std::vector<StageTime> stages_;
  StageTime* current_ = nullptr;
};

}  // namespace tessera
