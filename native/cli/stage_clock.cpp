#include "tessera/cli/stage_clock.h"

#include <algorithm>
#include <ctime>

namespace tessera {
namespace {

double milliseconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace

StageClock::StageClock() : start_(read()) {}

StageClock::Reading StageClock::read() {
  return {milliseconds(CLOCK_MONOTONIC), milliseconds(CLOCK_PROCESS_CPUTIME_ID)};
}

void StageClock::begin(std::string_view name) {
  end();
  const auto found = std::find_if(stages_.begin(), stages_.end(), [&](const StageTime& s) { return s.name == name; });
  current_ = found == stages_.end() ? &stages_.emplace_back(StageTime{std::string(name)}) : &*found;
  stage_start_ = read();
}

void StageClock::end() {
  if (!current_) return;
  const Reading now = read();
  current_->ms += now.ms - stage_start_.ms;
  current_->cpu_ms += now.cpu_ms - stage_start_.cpu_ms;
  current_ = nullptr;
}

double StageClock::total_ms() const { return read().ms - start_.ms; }

}  // namespace tessera
