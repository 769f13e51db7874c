#include "tessera/cli/signals.h"

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <string_view>

#include "tessera/cli/messages.h"

namespace tessera {
namespace {

// A signal handler reaches nothing but globals.
std::atomic<int> g_stop{static_cast<int>(StopReason::kNone)};
std::atomic<bool> g_unkillable{false}, g_bar_shown{false};
constexpr std::string_view kOutOfTime = "out of time (--timeout)";
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

// The first reason stays. True where this one is it.
bool stop_because(StopReason reason) {
  int none = static_cast<int>(StopReason::kNone);
  return g_stop.compare_exchange_strong(none, static_cast<int>(reason));
}

void on_interrupt(int signal) {
  if (stop_because(StopReason::kCancelled) || g_unkillable.load()) return;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void say(std::string_view text) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
}

// The first time the run is asked to stop. What has not asked at the next alarm is in the middle of a long step,
// which the whole program ends with: it has no files to remove but while it is unkillable.
void on_alarm(int) {
  if (stop_because(StopReason::kTimeout) || stop_reason() != StopReason::kTimeout || g_unkillable.load()) return;
  if (g_bar_shown.load()) say("\r\x1B[K");
  say("tessera: ");
  say(kOutOfTime);
  say("\n");
  _exit(exit_status(StatusCode::kTimeout));
}

timeval time_of(double seconds) {
  timeval time{};
  time.tv_sec = static_cast<time_t>(std::floor(seconds));
  time.tv_usec = static_cast<suseconds_t>(std::ceil((seconds - std::floor(seconds)) * 999999));
  return time;
}

// Without SA_RESTART: a read that waits for input ends.
void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

}  // namespace

const std::atomic<int>& stop_flag() { return g_stop; }

StopReason stop_reason() { return static_cast<StopReason>(g_stop.load()); }

Status stop_status() {
  end_time_limit();
  if (stop_reason() == StopReason::kTimeout) return {StatusCode::kTimeout, "", std::string(kOutOfTime)};
  return {StatusCode::kCancelled, "", "interrupted"};
}

void install_signal_handlers() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal, on_interrupt);
  handle(SIGPIPE, SIG_IGN);
}

void set_time_limit(double seconds) {
  constexpr double kGrace = 0.05, kLeast_s = 0.02;
  handle(SIGALRM, on_alarm);
  const itimerval timer{time_of(std::max(kLeast_s, kGrace * seconds)), time_of(seconds)};
  setitimer(ITIMER_REAL, &timer, nullptr);
}

void end_time_limit() {
  const itimerval never{};
  setitimer(ITIMER_REAL, &never, nullptr);
}

void bar_is_shown(bool shown) { g_bar_shown = shown; }

UnkillableScope::UnkillableScope() { g_unkillable = true; }
UnkillableScope::~UnkillableScope() { g_unkillable = false; }

}  // namespace tessera
