// What a running job may ask of the world outside: whether to go on, and where to say how far it is.
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

#include "tessera/base/status.h"

namespace tessera {

enum class StopReason : int { kNone = 0, kCancelled = 1, kTimeout = 2 };

// Owned by the caller and outlives the run. All members are optional; callbacks come on the thread that runs the job.
// The clock is the caller's: a stage lasts from its announcement to the next one.
struct RunContext {
  // Set from any thread or from a signal handler to end the run at the next check.
  const std::atomic<int>* stop = nullptr;
  // A stage of the job begins ("lloyd"). Names are stable; they are the `stages` of the report.
  std::function<void(std::string_view stage)> on_stage;
  // Done so far, 0..1, never falling.
  std::function<void(double fraction)> on_progress;
  // Something noteworthy that is no error, one line.
  std::function<void(std::string_view message)> on_warning;

  // Of techniques that run for long. They offer their state again and again, and once more when they are stopped; a
  // run that is handed it as `earlier` ends as if it had not been stopped. `state` may be called during the offer.
  std::function<void(const std::function<std::string()>& state)> on_state;
  std::string_view earlier;
  // That state may be of another job, which makes it no help; else it is an error.
  bool earlier_if_fits = false;
  // Whether to go on making the result better. Empty: as often as the job says.
  std::function<bool()> go_on_improving;

  void stage(std::string_view name) const {
    if (on_stage) on_stage(name);
  }
  void progress(double fraction) const {
    if (on_progress) on_progress(fraction);
  }
  void warn(std::string_view message) const {
    if (on_warning) on_warning(message);
  }

  // Empty while the run may go on, else kCancelled or kTimeout.
  Result<void> check() const {
    switch (stop ? static_cast<StopReason>(stop->load(std::memory_order_relaxed)) : StopReason::kNone) {
      case StopReason::kNone: return {};
      case StopReason::kTimeout: return fail(StatusCode::kTimeout, "", "out of time");
      case StopReason::kCancelled: break;
    }
    return fail(StatusCode::kCancelled, "", "cancelled");
  }
};

}  // namespace tessera
