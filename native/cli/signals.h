// Ends a run from outside: Ctrl-C, termination, the time limit.
#pragma once

#include <atomic>

#include "tessera/base/run_context.h"

namespace tessera {

// For RunContext::stop; holds a StopReason.
const std::atomic<int>& stop_flag();
StopReason stop_reason();
// kCancelled or kTimeout, in the words of the command line. Only after a stop; ends the time limit, as it is about to
// be told.
Status stop_status();

// From here on SIGINT, SIGTERM and SIGHUP set the flag once and kill the second time; writing to a closed pipe is an
// error instead of the end.
void install_signal_handlers();
// Sets the flag to kTimeout after so many seconds. A twentieth of them later the program ends by itself, wherever it
// is, but within an UnkillableScope.
void set_time_limit(double seconds);
void end_time_limit();
// Whether there is a progress bar on standard error, which goes before a last message.
void bar_is_shown(bool shown);

// While it lives a second signal does not kill, so that temporary files are removed in any case.
class UnkillableScope {
 public:
  UnkillableScope();
  ~UnkillableScope();
  UnkillableScope(const UnkillableScope&) = delete;
  UnkillableScope& operator=(const UnkillableScope&) = delete;
};

}  // namespace tessera
