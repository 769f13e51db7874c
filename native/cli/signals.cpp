#include "tessera/cli/signals.h"

#include <sys/time.h>

#include <cmath>
#include <csignal>

namespace tessera {
namespace {

// A signal handler reaches nothing but globals.
std::atomic<int> g_stop{static_cast<int>(StopReason::kNone)};
std::atomic<bool> g_unkillable{false};
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

void on_alarm(int) { stop_because(StopReason::kTimeout); }

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
  if (stop_reason() == StopReason::kTimeout) return {StatusCode::kTimeout, "", "out of time (--timeout)"};
  return {StatusCode::kCancelled, "", "interrupted"};
}

void install_signal_handlers() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) handle(signal, on_interrupt);
  handle(SIGPIPE, SIG_IGN);
}

void set_time_limit(double seconds) {
  handle(SIGALRM, on_alarm);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(std::floor(seconds));
  timer.it_value.tv_usec = static_cast<suseconds_t>(std::ceil((seconds - std::floor(seconds)) * 999999));
  setitimer(ITIMER_REAL, &timer, nullptr);
}

UnkillableScope::UnkillableScope() { g_unkillable = true; }
UnkillableScope::~UnkillableScope() { g_unkillable = false; }

}  // namespace tessera
