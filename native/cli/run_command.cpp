#include "tessera/cli/run_command.h"

#include <algorithm>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "tessera/cli/backend.h"
#include "tessera/cli/checkpoint.h"
#include "tessera/cli/flags.h"
#include "tessera/cli/inputs.h"
#include "tessera/cli/messages.h"
#include "tessera/cli/outputs.h"
#include "tessera/cli/progress.h"
#include "tessera/cli/report.h"
#include "tessera/cli/signals.h"
#include "tessera/cli/stage_clock.h"
#include "tessera/io/sha256.h"
#include "tessera/job/tile_by_tile.h"

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

    checkpoint_ = Checkpoint(checkpoint_path(settings_, request.formats));
    if (settings_.resume) {
      if (auto read = checkpoint_.read(); !read) return problem(std::move(read.error()));
    }
    begin("decode");
    const bool reports = !report_paths(settings_, request.formats).empty();
    if (goes_tile_by_tile(job_) && request.formats == std::vector<std::string>{"svg"} && !request.plots) {
      std::map<std::string, Input> drawing;
      auto rows = open_rows(job_, folder, reports, drawing["drawing"]);
      if (!rows) return problem(std::move(rows.error()));
      if (*rows) return go_tile_by_tile(**rows, drawing);
    }
    auto inputs = read_inputs(job_, folder, settings_.max_pixels, reports);
    if (!inputs) return tl::unexpected<Problems>(std::move(inputs.error()));
    begin("backend");
    auto backend = make_backend(settings_.backend);
    if (!backend) return problem(std::move(backend.error()));
    auto result = compute(*inputs, request, *backend);
    if (!result && result.error().front().field.empty() && stop_reason() == StopReason::kNone &&
        !checkpoint_.earlier().empty())
      result.error().front().field = checkpoint_.path();
    if (!result) return tl::unexpected<Problems>(std::move(result.error()));
    begin("write");
    auto written = write(*inputs, request.formats, *result, backend->rasterizer->name());
    if (!written) return problem(std::move(written.error()));
    return {};
  }

  const std::string& kept() const { return checkpoint_.kept(); }

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
    context.on_stage = [this](std::string_view stage) {
      begin(stage);
      improving_ = {};
    };
    context.on_progress = [this, leaps = !checkpoint_.earlier().empty()](double fraction) mutable {
      if (std::exchange(leaps, false)) bar_.begin_at(fraction);  // what the earlier run did is there at once
      bar_.progress(fraction);
    };
    context.on_warning = [this](std::string_view message) { warn(message); };
    if (!checkpoint_.path().empty())
      context.on_state = [this](const std::function<std::string()>& state) { checkpoint_.offer(state); };
    context.earlier = checkpoint_.earlier();
    if (settings_.improve_s > 0)
      context.go_on_improving = [this] { return improving_.seconds() < settings_.improve_s; };
    return context;
  }

  // Where GL was our choice, the CPU may take over.
  Rasterizer& with_fallback(Backend& backend) {
    if (settings_.backend == BackendChoice::kAuto && backend.context)
      let_cpu_take_over(backend, [this](const std::string& message) { warn(message); });
    return *backend.rasterizer;
  }

  tl::expected<JobResult, Problems> compute(const std::map<std::string, Input>& inputs, const JobRequest& request,
                                            Backend& backend) {
    Pictures pictures;
    for (const auto& [role, input] : inputs) pictures[role] = input.picture.view();
    return run_job(job_, pictures, request, with_fallback(backend), context());
  }

  // The SVG is written as it is made.
  tl::expected<void, Problems> go_tile_by_tile(RowSource& drawing, const std::map<std::string, Input>& inputs) {
    begin("backend");
    auto backend = make_backend(settings_.backend);
    if (!backend) return problem(std::move(backend.error()));
    const std::string& path = settings_.outputs.front().path;
    WrittenFile svg{path, 0, ""};
    Sha256 sum;
    const UnkillableScope unkillable;
    AtomicFiles files;
    if (auto begun = files.add(path, ""); !begun) return problem(std::move(begun.error()));
    const auto take = [&](std::string_view bytes) {
      svg.bytes += bytes.size();
      if (!settings_.report.empty()) sum.add(bytes);
      return files.append(bytes);
    };
    auto result = run_tile_by_tile(job_, drawing, with_fallback(*backend), context(), take);
    if (!result) return tl::unexpected<Problems>(std::move(result.error()));
    clock_.end();
    if (!settings_.report.empty()) svg.sha256 = sum.hex();
    auto done = add_job_and_report({svg}, inputs, *result, backend->rasterizer->name(), files);
    if (!done) return problem(std::move(done.error()));
    return {};
  }

  Result<void> add_job_and_report(std::vector<WrittenFile> written, const std::map<std::string, Input>& inputs,
                                  const JobResult& result, std::string_view backend, AtomicFiles& files) {
    if (auto saved = save_job(settings_, result.job, files, written); !saved) return saved;
    if (!settings_.report.empty()) {
      auto done = files.add(settings_.report, write_report(result.job, backend, inputs, result, written, clock_));
      if (!done) return done;
    }
    if (stop_reason() != StopReason::kNone) return tl::unexpected<Status>(stop_status());
    bar_.clear();
    return files.commit();
  }

  Result<void> write(const std::map<std::string, Input>& inputs, const std::vector<std::string>& formats,
                     const JobResult& result, std::string_view backend) {
    const UnkillableScope unkillable;
    AtomicFiles files;
    auto written = write_outputs(settings_, formats, result.job, result, files);
    if (!written) return tl::unexpected<Status>(std::move(written.error()));
    clock_.end();
    for (const std::string& path : report_paths(settings_, formats)) {
      auto done = files.add(path, write_report(result.job, backend, inputs, result, *written, clock_));
      if (!done) return done;
    }
    if (stop_reason() != StopReason::kNone) return tl::unexpected<Status>(stop_status());
    bar_.clear();
    if (!checkpoint_.path().empty()) files.remove(checkpoint_.path());
    auto done = files.commit();
    end_time_limit();  // too late to be late
    return done;
  }

  const Job& job_;
  const Settings& settings_;
  StageClock clock_;
  Checkpoint checkpoint_;
  Stopwatch improving_;  // since the stage began
  ProgressBar bar_{settings_.quiet ? ProgressMode::kNever : settings_.progress};
};

// Appends what changes the parameter that is the reason: "... (--half-side)".
void name_flags(const Job& job, ParametersFrom from, Problems& problems) {
  const auto append = [&](const std::vector<Parameter>& parameters, bool are_flags) {
    for (Status& problem : problems)
      for (const Parameter& parameter : parameters)
        if (problem.code == StatusCode::kInvalidParameter && problem.field == parameter.info.key)
          problem.message += " (" + (are_flags ? flag_of(parameter) : std::string("--set")) + ")";
  };
  append(parameters_of(job.params), from == ParametersFrom::kFlags);
  append(setting_flags(), true);
}

}  // namespace

void prepare(const Settings& settings) {
  // More threads than processors are slower, and the library that runs them complains.
  if (settings.threads > 0) cv::setNumThreads(std::min(settings.threads, cv::getNumberOfCPUs()));
  if (settings.timeout_s > 0) set_time_limit(settings.timeout_s);
}

int run_and_write(Job job, const Settings& settings, const std::string& folder, ParametersFrom from) {
  if (settings.seed) job.seed = *settings.seed;
  auto run = std::make_unique<Run>(job, settings);
  auto done = (*run)(folder);
  const std::string kept = run->kept();
  run.reset();  // and its bar, before anything is said
  if (done) return kExitDone;
  // Whatever failed once we were told to stop failed for that reason.
  if (stop_reason() == StopReason::kNone) {
    name_flags(job, from, done.error());
    return print_problems(done.error());
  }
  Status stopped = stop_status();
  if (!kept.empty()) stopped.message += "; what is done is kept in " + kept + ", --resume goes on";
  return print_problems({stopped});
}

tl::expected<std::string, Problems> ask_job(Job job, const Question& question, const Settings& settings) {
  const Technique& technique = technique_of(job.params);
  std::erase_if(job.inputs, [&](const auto& input) {
    const InputRole* role = role_of(technique, input.first);
    return !role || std::find(question.inputs.begin(), question.inputs.end(), role->name) == question.inputs.end();
  });
  const auto inputs = read_inputs(job, "", settings.max_pixels, false);
  if (!inputs) return tl::unexpected<Problems>(inputs.error());
  Pictures pictures;
  for (const auto& [role, input] : *inputs) pictures[role] = input.picture.view();
  RunContext context;
  context.stop = &stop_flag();
  context.on_warning = [&](std::string_view message) {
    if (!settings.quiet) print_message("warning: " + std::string(message));
  };
  auto answer = question.answer(job, pictures, context);
  if (!answer) return problem(stop_reason() == StopReason::kNone ? answer.error() : stop_status());
  return *std::move(answer);
}

}  // namespace tessera
