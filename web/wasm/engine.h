// The core as one long-lived object, in plain types: what binding.cpp offers to JavaScript.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tessera/job/fit.h"
#include "tessera/job/job.h"
#include "tessera/job/measure.h"
#include "tessera/parquetry/live_grid.h"

namespace tessera {

enum class BackendChoice { kAuto, kCpu, kGl };

// A role's picture: rows from the top.
struct Input {
  cv::Mat3b rgb;         // over white
  cv::Mat1b alpha = {};  // of the same size; empty: all of it is opaque
  double dpi = 0;        // pixels an inch; 0: nobody knows
};

class Engine {
 public:
  // Keeps the role's picture for the runs that follow.
  void set_picture(const std::string& role, Input picture) { pictures_[role] = std::move(picture); }
  void forget_picture(const std::string& role) { pictures_.erase(role); }

  // Tells that a WebGL2 context is current on this thread. Fails where the diagram cannot be drawn with it.
  Result<void> use_gl(bool software);

  // The result stays for artifact() until the next run, with its iterations for "apng"; what of it took long is not
  // done again where the next job differs only in what comes after. Whatever the choice, the CPU
  // takes over where GL fails on the way. `backend` is set to the one that drew last.
  tl::expected<const Outcome*, Problems> run(const Job& job, BackendChoice choice, RunContext context,
                                             const IterationObserver& observer, std::string& backend);
  tl::expected<Artifact, Problems> artifact(const std::string& format) const;
  tl::expected<std::vector<Artifact>, Problems> artifacts(const std::string& format) const;  // of "folder" many

  // The job's morphed grid, to work on until the next is begun; its pictures were set. Problems as in run().
  tl::expected<parquetry::LiveGrid*, Problems> begin_grid(const Job& job);
  parquetry::LiveGrid* live_grid() const { return live_grid_.get(); }  // null: none has begun

  // What one of the technique's questions is answered with for the job and the pictures that were set.
  tl::expected<std::string, Problems> ask(const std::string& question, const Job& job, RunContext context);

  // Of a picture, or of the bytes of a file that read_pattern_file() knows.
  tl::expected<Measured, Problems> measure(const cv::Mat3b& picture, const MeasureOptions& options,
                                           RunContext context);
  tl::expected<Measured, Problems> measure(std::string_view file, const MeasureOptions& options, RunContext context);
  tl::expected<Fit, Problems> fit(const cv::Mat3b& picture, std::uint64_t seed, RunContext context);

  // Non-zero ends what is going on.
  std::atomic<int>& stop() { return stop_; }

 private:
  void begin(RunContext& context);
  Pictures pictures() const;
  std::unique_ptr<Rasterizer> make_rasterizer(BackendChoice choice, const RunContext& context);

  struct Finished {
    Job job;
    Outcome outcome;
  };
  std::map<std::string, Input> pictures_;
  std::optional<Finished> finished_;
  std::unique_ptr<parquetry::LiveGrid> live_grid_;
  std::string state_;  // that the last long run has left
  std::atomic<int> stop_{0};
  bool has_gl_ = false, gl_is_software_ = false;
};

}  // namespace tessera
