// A bar on standard error: how far, what is being done, and how long it will take.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace tessera {

enum class ProgressMode { kAuto, kAlways, kNever };

class ProgressBar {
 public:
  // kAuto shows it where standard error is a terminal.
  explicit ProgressBar(ProgressMode mode);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void stage(std::string_view name);
  void progress(double fraction);  // 0 to 1
  // So much was there before: the time left is told by what comes from now on.
  void begin_at(double fraction);
  // Takes the bar off the screen, so that a line can be written; the next change brings it back.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  void draw();

  bool shown_;
  bool on_screen_ = false;
  std::string stage_;
  double fraction_ = 0, begun_at_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
};

}  // namespace tessera
