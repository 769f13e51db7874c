#include "engine.h"

#include <algorithm>
#include <utility>

#include "tessera/gpu/gl_rasterizer.h"
#include "tessera/job/guarded.h"
#include "tessera/job/parquet_job.h"
#include "tessera/job/techniques.h"
#include "tessera/voronoi/cpu_rasterizer.h"
#include "tessera/voronoi/fallback_rasterizer.h"

namespace tessera {

namespace {

ImageView view_of(const cv::Mat3b& picture) {
  return {picture.ptr(), picture.cols, picture.rows, static_cast<std::ptrdiff_t>(picture.step)};
}

ImageView view_of(const Input& input) {
  ImageView view = view_of(input.rgb);
  view.alpha = input.alpha.empty() ? nullptr : input.alpha.ptr();
  view.dpi = input.dpi;
  return view;
}

}  // namespace

Result<void> Engine::use_gl(bool software) {
  gl_is_software_ = software;
  auto rasterizer = make_gl_rasterizer();
  has_gl_ = rasterizer.has_value();
  return rasterizer.map([](const auto&) {});
}

std::unique_ptr<Rasterizer> Engine::make_rasterizer(BackendChoice choice, const RunContext& context) {
  auto cpu = make_cpu_rasterizer();
  const bool wanted = choice == BackendChoice::kGl || (choice == BackendChoice::kAuto && !gl_is_software_);
  if (!has_gl_ || !wanted) return cpu;
  const auto warn = [this, &context](const Status& reason) {
    has_gl_ = false;
    context.warn("drawing with the graphics card failed (" + reason.message + "), the processor takes over");
  };
  auto gl = make_gl_rasterizer();
  if (gl) return make_fallback_rasterizer(*std::move(gl), std::move(cpu), warn);
  warn(gl.error());
  return cpu;
}

void Engine::begin(RunContext& context) {
  stop_ = 0;
  context.stop = &stop_;
}

Pictures Engine::pictures() const {
  Pictures pictures;
  for (const auto& [role, picture] : pictures_) pictures[role] = view_of(picture);
  return pictures;
}

tl::expected<const Outcome*, Problems> Engine::run(const Job& job, BackendChoice choice, RunContext context,
                                                   const IterationObserver& observer, std::string& backend) {
  finished_.reset();  // its memory is wanted now
  begin(context);
  context.earlier = state_;
  context.earlier_if_fits = true;
  const auto rasterizer = make_rasterizer(choice, context);
  auto outcome = compute_job(job, pictures(), *rasterizer, context, observer, /*records=*/true);
  if (!outcome) return tl::unexpected<Problems>(std::move(outcome.error()));
  backend = rasterizer->name();
  if (!outcome->state.empty()) state_ = std::move(outcome->state);
  finished_ = Finished{job, *std::move(outcome)};
  return &finished_->outcome;
}

tl::expected<std::vector<Artifact>, Problems> Engine::artifacts(const std::string& format) const {
  if (!finished_) {
    return tl::unexpected<Problems>(
        Problems{{StatusCode::kInvalidParameter, format, "has no run to come from, expected a finished one"}});
  }
  return write_artifacts(finished_->job, finished_->outcome, {.formats = {format}}, {});
}

tl::expected<Artifact, Problems> Engine::artifact(const std::string& format) const {
  return artifacts(format).map([](std::vector<Artifact>&& all) { return std::move(all.front()); });
}

tl::expected<parquetry::LiveGrid*, Problems> Engine::begin_grid(const Job& job) {
  auto begun = guarded([&]() -> Result<bool> {
    if (!std::holds_alternative<parquetry::Params>(job.params))
      return fail(StatusCode::kInvalidParameter, "technique", "has no grid, expected parquetry");
    const auto done = begin_live_grid(job, pictures(), live_grid_);
    if (!done) return tl::unexpected<Status>(done.error());
    return true;
  });
  if (!begun) return tl::unexpected<Problems>(std::move(begun.error()));
  return live_grid_.get();
}

tl::expected<std::string, Problems> Engine::ask(const std::string& question, const Job& job, RunContext context) {
  const auto& questions = technique_of(job.params).questions;
  const auto asked =
      std::find_if(questions.begin(), questions.end(), [&](const Question& q) { return q.name == question; });
  if (asked == questions.end())
    return tl::unexpected<Problems>(
        Problems{{StatusCode::kInvalidParameter, question, "is no question of the technique"}});
  begin(context);
  const Pictures given = pictures();
  const auto looks_at = [&](std::string_view role) {
    return std::find(asked->inputs.begin(), asked->inputs.end(), role) != asked->inputs.end();
  };
  for (const InputRole& role : technique_of(job.params).inputs)
    if (!role.many && role.required && looks_at(role.name) && given.count(std::string(role.name)) == 0)
      return tl::unexpected<Problems>(
          Problems{{StatusCode::kInvalidInput, std::string(role.name), "is missing, expected a picture"}});
  return guarded([&] { return asked->answer(job, given, context); });
}

tl::expected<Measured, Problems> Engine::measure(const cv::Mat3b& picture, const MeasureOptions& options,
                                                 RunContext context) {
  begin(context);
  return guarded([&] { return measure_picture(view_of(picture), options, context); });
}

tl::expected<Measured, Problems> Engine::measure(std::string_view file, const MeasureOptions& options,
                                                 RunContext context) {
  begin(context);
  return guarded([&]() -> Result<Measured> {
    const auto read = read_pattern_file(file);
    if (!read) return tl::unexpected<Status>(read.error());
    return measure_pattern(*read, options, context);
  });
}

tl::expected<Fit, Problems> Engine::fit(const cv::Mat3b& picture, std::uint64_t seed, RunContext context) {
  begin(context);
  return guarded([&] { return fit_pattern(view_of(picture), seed, context); });
}

}  // namespace tessera
