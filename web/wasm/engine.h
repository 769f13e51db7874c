// The core as one long-lived object, in plain types: what binding.cpp offers to JavaScript.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tessera/job/job.h"

namespace tessera {

enum class BackendChoice { kAuto, kCpu, kGl };

class Engine {
 public:
  // Pixels of the role's picture for the caller to fill: RGB, rows from the top. kInvalidInput for a size that cannot
  // be.
  Result<cv::Mat3b> new_picture(const std::string& role, int width, int height);
  void forget_picture(const std::string& role);

  // Tells that a WebGL2 context is current on this thread. Fails where the diagram cannot be drawn with it.
  Result<void> use_gl(bool software);

  // The result stays for artifact() until the next run, with its iterations for "apng". Whatever the choice, the CPU takes over where GL fails on the
  // way. `backend` is set to the one that drew last.
  tl::expected<const Outcome*, Problems> run(const Job& job, BackendChoice choice, RunContext context,
                                             const IterationObserver& observer, std::string& backend);
  tl::expected<Artifact, Problems> artifact(const std::string& format) const;

  // Non-zero ends the run that is going on.
  std::atomic<int>& stop() { return stop_; }

 private:
  std::unique_ptr<Rasterizer> make_rasterizer(BackendChoice choice, const RunContext& context);

  struct Finished {
    Job job;
    Outcome outcome;
  };
  std::map<std::string, cv::Mat3b> pictures_;
  std::optional<Finished> finished_;
  std::atomic<int> stop_{0};
  bool has_gl_ = false, gl_is_software_ = false;
};

}  // namespace tessera
