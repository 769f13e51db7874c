#include "tessera/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "tessera/cli/signals.h"

namespace tessera {
namespace {

constexpr int kWidth = 24;
constexpr std::chrono::milliseconds kBetweenDrawings{100};

// `done`: of what was left to do when the time began.
std::string time_left(double elapsed_s, double done) {
  constexpr double kTooEarly = 0.02;
  if (done < kTooEarly) return "";
  const int seconds = static_cast<int>(std::lround(elapsed_s * (1 - done) / done));
  return seconds < 60 ? fmt::format(", {} s left", seconds)
                      : fmt::format(", {}:{:02} left", seconds / 60, seconds % 60);
}

}  // namespace

ProgressBar::ProgressBar(ProgressMode mode)
    : shown_(mode == ProgressMode::kAlways || (mode == ProgressMode::kAuto && isatty(STDERR_FILENO))) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::stage(std::string_view name) {
  stage_ = name;
  draw();
}

void ProgressBar::progress(double fraction) {
  fraction_ = fraction;
  if (Clock::now() - drawn_ >= kBetweenDrawings) draw();
}

void ProgressBar::begin_at(double fraction) {
  start_ = Clock::now();
  begun_at_ = fraction;
}

void ProgressBar::clear() {
  if (on_screen_) std::fputs("\r\x1B[K", stderr);
  on_screen_ = false;
  bar_is_shown(false);
}

void ProgressBar::draw() {
  if (!shown_) return;
  drawn_ = Clock::now();
  const double elapsed = std::chrono::duration<double>(drawn_ - start_).count();
  const double done = begun_at_ < 1 ? (fraction_ - begun_at_) / (1 - begun_at_) : 1;
  const auto filled = static_cast<std::size_t>(fraction_ * kWidth);
  fmt::print(stderr, "\r[{:<{}}] {:3.0f}% {}{}\x1B[K", std::string(filled, '#'), kWidth, 100 * fraction_, stage_,
             time_left(elapsed, done));
  on_screen_ = true;
  bar_is_shown(true);
}

}  // namespace tessera
