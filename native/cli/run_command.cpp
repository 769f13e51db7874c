#include "tessera/cli/run_command.h"

#include <utility>

#include "tessera/cli/backend.h"
#include "tessera/cli/inputs.h"
#include "tessera/cli/messages.h"
#include "tessera/cli/outputs.h"
#include "tessera/cli/progress.h"
#include "tessera/cli/report.h"
#include "tessera/cli/signals.h"
#include "tessera/cli/stage_clock.h"
#include "tessera/voronoi/fallback_rasterizer.h"

namespace tessera {
namespace {

tl::unexpected<Problems> problem(Status status) { return tl::unexpected<Problems>(Problems{std::move(status)}); }

class Run {
 public:
  Run(const Job& job, const Settings& settings) : job_(job), settings_(settings) {}

  tl::expected<void, Problems> operator()(const std::string& folder) {
    JobRequest request;
    Problems problems;
    request.formats = plan_formats(settings_, job_, problems);
    request.plots = !settings_.plots.empty();
    request.png_scale = settings_.png_scale;
    if (!problems.empty()) return tl::unexpected<Problems>(std::move(problems));

    begin("decode");
    auto inputs = read_inputs(job_, folder, settings_.max_pixels, !settings_.report.empty());
    if (!inputs) return tl::unexpected<Problems>(std::move(inputs.error()));
    begin("backend");
    auto backend = make_backend(settings_.backend);
    if (!backend) return problem(std::move(backend.error()));
    auto result = compute(*inputs, request, *backend);
    if (!result) return tl::unexpected<Problems>(std::move(result.error()));
    begin("write");
    auto written = write(*inputs, *result, backend->rasterizer->name());
    if (!written) return problem(std::move(written.error()));
    return {};
  }

 private:
  void begin(std::string_view stage) {
    clock_.begin(stage);
    bar_.stage(stage);
  }

  void warn(std::string_view message) {
    if (settings_.quiet) return;
    bar_.clear();
    print_message("warning: " + std::string(message));
  }

  RunContext context() {
    RunContext context;
    context.stop = &stop_flag();
    context.on_stage = [this](std::string_view stage) { begin(stage); };
    context.on_progress = [this](double fraction) { bar_.progress(fraction); };
    context.on_warning = [this](std::string_view message) { warn(message); };
    return context;
  }

  // Where GL was our choice and fails on the way, the CPU takes over.
  tl::expected<JobResult, Problems> compute(const std::map<std::string, Input>& inputs, const JobRequest& request,
                                            Backend& backend) {
    Pictures pictures;
    for (const auto& [role, input] : inputs) pictures[role] = input.picture.view();
    if (settings_.backend == BackendChoice::kAuto && backend.context) {
      backend.rasterizer = make_fallback_rasterizer(
          std::move(backend.rasterizer), cpu_backend().rasterizer, [this](const Status& reason) {
            warn("the gl backend failed (" + reason.message + "), the cpu takes over");
          });
    }
    return run_job(job_, pictures, request, *backend.rasterizer, context());
  }

  Result<void> write(const std::map<std::string, Input>& inputs, const JobResult& result, std::string_view backend) {
    const UnkillableScope unkillable;
    AtomicFiles files;
    auto written = write_outputs(settings_, job_, result, files);
    if (!written) return tl::unexpected<Status>(std::move(written.error()));
    clock_.end();
    if (!settings_.report.empty()) {
      auto done = files.add(settings_.report, write_report(job_, backend, inputs, result, *written, clock_));
      if (!done) return done;
    }
    if (stop_reason() != StopReason::kNone) return tl::unexpected<Status>(stop_status());
    bar_.clear();
    return files.commit();
  }

  const Job& job_;
  const Settings& settings_;
  StageClock clock_;
  ProgressBar bar_{settings_.quiet ? ProgressMode::kNever : settings_.progress};
};

}  // namespace

int run_and_write(Job job, const Settings& settings, const std::string& folder) {
  if (settings.seed) job.seed = *settings.seed;
  const auto done = Run(job, settings)(folder);
  if (done) return kExitDone;
  // Whatever failed once we were told to stop failed for that reason.
  return print_problems(stop_reason() == StopReason::kNone ? done.error() : Problems{stop_status()});
}

}  // namespace tessera
